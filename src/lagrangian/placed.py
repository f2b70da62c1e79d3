"""The methods that describe where things are: points, frames, and frames that float or turn in ball joints."""

from __future__ import annotations

from lagrangian.calls import Guided, worded
from lagrangian.model import Builder, Frame, Point
from lagrangian.model.decimals import describes


@worded
@describes
class PointsAndFrames(Guided):
    """The methods that add points and frames; points are relative to points, frames to frames."""

    _builder: Builder

    def point(
        self, name: str, offset: object, *, relative_to: Point | None = None, frame: Frame | None = None
    ) -> Point:
        """Return a named point, ``offset`` from ``relative_to`` (default: the origin) along the axes of ``frame``."""
        return self._builder.point(name, offset, parent=relative_to, frame=frame)

    def frame(
        self,
        angle: object,
        *,
        axis: object = None,
        parent: Frame | None = None,
        origin: Point | None = None,
        name: str | None = None,
    ) -> Frame:
        """Return a frame turned by ``angle`` relative to ``parent``; in space, about ``axis``."""
        return self._builder.frame(name, angle, axis=axis, parent=parent, origin=origin)

    def floating_frame(self, name: str) -> Frame:
        """Return a frame that moves and turns freely in space; ``base = floating_frame("base")`` also makes
        ``base.origin``.

        Coordinates: base_x, base_y, base_z (the origin, in fixed axes) and the quaternion base_qx, base_qy, base_qz,
        base_qw. Velocities: base_vx, base_vy, base_vz (of the origin) and base_wx, base_wy, base_wz (angular), along
        the frame's axes. ``base.origin`` is the point base_origin.
        """
        return self._builder.floating_frame(name)

    def ball_frame(self, name: str, *, parent: Frame | None = None, origin: Point | None = None) -> Frame:
        """Return a frame that turns freely about ``origin``, as in a ball joint: ``arm = ball_frame("arm")``.

        The origin is by default that of ``parent``, which carries it. Coordinates: the quaternion arm_qx, arm_qy,
        arm_qz, arm_qw, from the frame's axes to the parent's (the fixed axes, without a parent). Velocities: arm_wx,
        arm_wy, arm_wz, the angular velocity relative to the parent along the frame's own axes.
        """
        return self._builder.ball_frame(name, parent=parent, origin=origin)
