"""Copies between strided arrays and blocks: the rows of many states become one vector per entry, and back.

Arrays hold the entries of a state side by side; blocks hold the states of an entry side by side. So copying is a
transposition. Contiguous rows are transposed W × W in registers, where W is the number of lanes and, for the rest of a
row, a smaller power of two. Pieces overlap if the length of a row is not a multiple, so nothing outside a row is
touched. With any other stride, numbers are copied one by one.
"""

from __future__ import annotations

from collections.abc import Callable

from .ir import Function, Module, Value, shuffle_mask

SUMS = 4
"""The number of sums of 0·x that are computed side by side: a single one would wait for itself longer than the copies
take."""


def emit_move(module: Module, lanes: int, n: int, *, gather: bool) -> str:
    """Print ``gather`` (array → block) or ``scatter`` (block → array) for rows of ``n`` entries; return its symbol.

    Signature: ``(ptr base, i64 row, i64 step, ptr block)``; lane l is the row at ``base + l row``, with entries
    ``step`` bytes apart. It returns Σ 0·x in every lane, which is zero exactly if every number is finite.
    """
    name = f"{'gather' if gather else 'scatter'}_{lanes}_{n}"
    if module.defines(name):
        return "@" + name
    f = Function(module, lanes)
    rows = ["%base"]
    for k in range(1, lanes):
        rows.append(f.put(f"getelementptr i8, ptr %base, i64 {f.put(f'mul i64 %row, {k}')}"))
    f.do("%columns = icmp eq i64 %row, 8")
    f.do("br i1 %columns, label %beside, label %apart")
    mover = Transposer(f, rows, gather)
    f.label("beside")
    mover.side_by_side(n)
    f.label("apart")
    f.do("%plain = icmp eq i64 %step, 8")
    f.do("br i1 %plain, label %near, label %far")
    f.label("near")
    mover.contiguous(n)
    f.label("far")
    mover.strided(n)
    arguments = "ptr %base, i64 %row, i64 %step, ptr %block"
    f.finish(name, f"internal {f.real}", arguments, f'nounwind noinline "prefer-vector-width"="{lanes * 64}"')
    return "@" + name


class Transposer:
    """Prints the two kinds of copies; ``rows`` are the addresses of the lanes' rows."""

    def __init__(self, f: Function, rows: list[str], gather: bool) -> None:
        self.f, self.rows, self.gather = f, rows, gather

    def contiguous(self, n: int) -> None:
        """Contiguous rows: full transpositions in a loop, then the rest in one or two smaller ones."""
        f, lanes = self.f, self.f.lanes
        full = n // lanes
        total = Value(f, f.constant(0.0))
        if full:
            f.do("br label %tiles")
            f.label("tiles")
            f.do("%tile = phi i64 [0, %near], [%nexttile, %tiles]")
            start_of_sum = len(f.lines)  # the second phi uses a value that is printed below
            total = self.tile("%tile", lanes, Value(f, "%tilesum"))
            f.lines.insert(
                start_of_sum, f"  %tilesum = phi {f.real} [{f.constant(0.0)}, %near], [{total.name}, %tiles]"
            )
            f.do(f"%nexttile = add i64 %tile, {lanes}")
            f.do(f"%moretiles = icmp slt i64 %nexttile, {full * lanes}")
            f.do("br i1 %moretiles, label %tiles, label %rest")
            f.label("rest")
        for start, width in self.pieces(n)[full:]:
            total = self.tile(str(start), width, total)
        f.do(f"ret {f.real} {total.name}")

    def pieces(self, n: int) -> list[tuple[int, int]]:
        """Start and width of the tiles that cover a row: full ones, then smaller ones, which may overlap."""
        lanes = self.f.lanes
        full, rest = divmod(n, lanes)
        found = [(k * lanes, lanes) for k in range(full)]
        done = full * lanes
        while rest:
            width = 1 << (rest - 1).bit_length()
            if width > n:  # no room to overlap: the largest piece that fits
                width //= 2
            start = min(done, n - width)
            found.append((start, width))
            rest -= start + width - done
            done = start + width
        return found

    def tile(self, first: str, width: int, total: Value) -> Value:
        """Copy entries ``first`` … ``first + width − 1`` of every row; return the new sum."""
        f = self.f
        slots = []
        for k in range(width):
            slot = f.put(f"getelementptr {f.real}, ptr %block, i64 {first}")
            slots.append(f.put(f"getelementptr {f.real}, ptr {slot}, i64 {k}"))
        if self.gather:
            vectors = self.lifted(first, width)
            for slot, x in zip(slots, vectors, strict=True):
                f.do(f"store {f.real} {x}, ptr {slot}, align {8 * f.lanes}")
        else:
            vectors = [f.put(f"load {f.real}, ptr {slot}, align {8 * f.lanes}") for slot in slots]
            self.dropped(first, width, vectors)
        return self.noted(vectors, total)

    def lifted(self, first: str, width: int) -> list[str]:
        """Load entries ``first`` … of the rows, as one vector per entry."""
        f = self.f
        kind = "double" if width == 1 else f"<{width} x double>"
        pieces = [f.put(f"load {kind}, ptr {place}, align 8") for place in self._places(first)]
        return self.transposed(self.joined(pieces, width), width)

    def dropped(self, first: str, width: int, vectors: list[str]) -> None:
        """Store vectors as entries ``first`` … of the rows."""
        f = self.f
        kind = "double" if width == 1 else f"<{width} x double>"
        parts = self.parted(self.transposed(vectors, width), width)
        for piece, place in zip(parts, self._places(first), strict=True):
            f.do(f"store {kind} {piece}, ptr {place}, align 8")

    def _places(self, first: str) -> list[str]:
        return [self.f.put(f"getelementptr double, ptr {row}, i64 {first}") for row in self.rows]

    def noted(self, vectors: list[str], total: Value) -> Value:
        """``total`` + Σ 0·x, as several sums side by side."""
        f = self.f
        sums = [total]
        for k, x in enumerate(vectors):
            if 0 < k < SUMS:
                sums.append(Value(f, x) * 0.0)
            else:
                sums[k % SUMS] = f.fma(Value(f, x), 0.0, sums[k % SUMS])
        while len(sums) > 1:
            sums = [a + b for a, b in zip(sums[::2], sums[1::2], strict=False)] + sums[len(sums) & ~1 :]
        return sums[0]

    def joined(self, pieces: list[str], width: int) -> list[str]:
        """Vector k consists of the pieces of rows k, k + width, k + 2 width …, one after another."""
        f = self.f
        if width == 1:
            return [f.gathered(pieces).name]
        narrow = f.widened(width)
        return [narrow.joined(pieces[k::width], f).name for k in range(width)]

    def parted(self, vectors: list[str], width: int) -> list[str]:
        """The reverse of :meth:`joined`: one piece per row."""
        f = self.f
        if width == 1:
            return [f.lane(Value(f, vectors[0]), k) for k in range(f.lanes)]
        pieces = []
        for row in range(f.lanes):
            start = row // width * width
            vector = vectors[row % width]
            if width == f.lanes:
                pieces.append(vector)
            else:
                mask = shuffle_mask(range(start, start + width))
                pieces.append(f.put(f"shufflevector {f.real} {vector}, {f.real} poison, {mask}"))
        return pieces

    def transposed(self, vectors: list[str], width: int) -> list[str]:
        """Transpose every width × width tile across the vectors, in log2 width rounds that exchange halves,
        quarters, …."""
        f = self.f
        vectors = list(vectors)
        stride = 1
        while stride < width:
            low = shuffle_mask(j if not j & stride else f.lanes + j - stride for j in range(f.lanes))
            high = shuffle_mask(j + stride if not j & stride else f.lanes + j for j in range(f.lanes))
            for k in range(width):
                if not k & stride:
                    pair = f"{f.real} {vectors[k]}, {f.real} {vectors[k + stride]}"
                    vectors[k], vectors[k + stride] = (f.put(f"shufflevector {pair}, {m}") for m in (low, high))
            stride *= 2
        return vectors

    def side_by_side(self, n: int) -> None:
        """States next to each other, as in Fortran order or in rows of one entry: whole vectors are copied, entry by
        entry."""
        f = self.f

        def move(slot: str) -> Value:
            place = f.put("getelementptr i8, ptr %base, i64 %sideoffset")
            whole = 8 * f.lanes
            source, target, have, want = (place, slot, 8, whole) if self.gather else (slot, place, whole, 8)
            x = f.put(f"load {f.real}, ptr {source}, align {have}")
            f.do(f"store {f.real} {x}, ptr {target}, align {want}")
            return Value(f, x)

        self._entries(n, "beside", "side", move)

    def strided(self, n: int) -> None:
        """Any strides: numbers are copied entry by entry and lane by lane."""
        f = self.f

        def move(slot: str) -> Value:
            places = [f.put(f"getelementptr i8, ptr {row}, i64 %stepoffset") for row in self.rows]
            if self.gather:
                x = f.gathered([f.put(f"load double, ptr {place}, align 8") for place in places])
                f.do(f"store {f.real} {x.name}, ptr {slot}, align {8 * f.lanes}")
                return x
            x = Value(f, f.put(f"load {f.real}, ptr {slot}, align {8 * f.lanes}"))
            for lane, place in enumerate(places):
                f.do(f"store double {f.lane(x, lane)}, ptr {place}, align 8")
            return x

        self._entries(n, "far", "step", move)

    def _entries(self, n: int, entry: str, name: str, move: Callable[[str], Value]) -> None:
        """A loop over entries after the block ``entry``; ``move`` prints one copy, ``%<name>offset`` bytes into a
        row."""
        f = self.f
        f.do(f"br label %{name}loop")
        f.label(f"{name}loop")
        f.do(f"%{name}k = phi i64 [0, %{entry}], [%{name}next, %{name}loop]")
        f.do(f"%{name}offset = phi i64 [0, %{entry}], [%{name}ahead, %{name}loop]")
        start_of_sum = len(f.lines)  # the third phi uses a value that is printed below
        x = move(f.put(f"getelementptr {f.real}, ptr %block, i64 %{name}k"))
        total = f.fma(x, 0.0, Value(f, f"%{name}sum"))
        phi = f"  %{name}sum = phi {f.real} [{f.constant(0.0)}, %{entry}], [{total.name}, %{name}loop]"
        f.lines.insert(start_of_sum, phi)
        f.do(f"%{name}next = add i64 %{name}k, 1")
        f.do(f"%{name}ahead = add i64 %{name}offset, %step")
        f.do(f"%{name}more = icmp slt i64 %{name}next, {n}")
        f.do(f"br i1 %{name}more, label %{name}loop, label %{name}end")
        f.label(f"{name}end")
        f.do(f"ret {f.real} {total.name}")
