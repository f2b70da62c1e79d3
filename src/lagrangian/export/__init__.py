"""Writes a system for other programs: source code of many languages, and the integrator for pages.

A target is one file here, one line in `targets`, and the check that runs it in `lagrangian.verify.exports`.
"""

from typing import TYPE_CHECKING

from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.export.programs import exported, program_of
    from lagrangian.export.targets import ENDINGS, TARGETS, exported_files, sources, target_of
else:
    __getattr__ = lazily(
        __name__,
        {
            "programs": "exported program_of",
            "targets": "ENDINGS TARGETS exported_files sources target_of",
        },
    )

__all__ = ["ENDINGS", "TARGETS", "exported", "exported_files", "program_of", "sources", "target_of"]
