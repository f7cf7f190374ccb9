"""Points on the cubic curves of UsdGeomBasisCurves, as its documentation defines them."""

import numpy as np

# Coefficients of t^3, t^2, t and 1 (rows) of the weights of four control vertices (columns).
BASES = {
    "bezier": np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 3, 0, 0], [1, 0, 0, 0]]),
    "bspline": np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 0, 3, 0], [1, 4, 1, 0]]) / 6,
    "catmullRom": np.array([[-1, 3, -3, 1], [2, -5, 4, -1], [-1, 0, 1, 0], [0, 2, 0, 0]]) / 2,
}


def starts(sizes):
    """Returns the index of the first element of each group, for groups one after another."""
    return np.cumsum(sizes) - sizes


class CubicCurves:
    """Curves of one basis. A curve becomes the ends of its segments and `between` points evenly in
    t between two ends. At first these are the fewest that give no curve fewer points than control
    vertices, so that shapes are kept about as well as they were drawn. A curve of one vertex stays a
    point."""

    def __init__(self, basis, wrap, sizes):
        """`sizes`: control vertices of each curve. Raises ValueError for invalid curves."""
        if basis not in BASES:
            raise ValueError(f"unknown basis '{basis}'; known: {', '.join(BASES)}")
        self.basis = BASES[basis]
        self.step = 3 if basis == "bezier" else 1
        # A pinned Bézier curve ends at its vertices anyway; others get a vertex at both ends.
        self.pinned = wrap == "pinned" and basis != "bezier"
        self.sizes = np.asarray(sizes, np.int64)
        self.drawn = self.sizes > 1  # others have no segment
        padded = self.sizes + 2 * self.drawn if self.pinned else self.sizes
        wrong = np.flatnonzero(self.drawn & ((padded < 4) | ((padded - 4) % self.step != 0)))
        if wrong.size:
            raise ValueError(
                f"curve {wrong[0]} has {self.sizes[wrong[0]]} vertices, which do not make a {wrap} {basis} curve"
            )
        self.segments = np.where(self.drawn, (padded - 4) // self.step + 1, 0)
        self.padded = padded
        self.first_control = self._per_segment(starts(padded), self.step)
        self.between = 0
        if self.drawn.any():
            pieces = -(-(self.sizes - 1)[self.drawn] // self.segments[self.drawn])
            self.between = int(np.max(pieces)) - 1

    def point_counts(self):
        return np.where(self.drawn, self.segments * (self.between + 1) + 1, self.sizes)

    def ends(self):
        """Returns the number of ends of segments of each curve."""
        return np.where(self.drawn, self.segments + 1, self.sizes)

    def vertex(self, values):
        """Returns points from one value (row) for each control vertex."""
        controls = self._with_phantoms(values) if self.pinned else values
        corners = controls[self.first_control[:, None] + np.arange(4)]
        points = values[starts(self.sizes)[self.sizes == 1]]
        return self._place(lambda t: t ** np.arange(3, -1, -1) @ self.basis, corners, points)

    def varying(self, values):
        """Returns points by linear interpolation of one value for each end of a segment."""
        first = self._per_segment(starts(self.ends()), 1)
        ends = values[first[:, None] + np.arange(2)]
        points = values[starts(self.ends())[self.sizes == 1]]
        return self._place(lambda t: np.array([1 - t, t]), ends, points)

    def _per_segment(self, first, step):
        """Returns first[curve] + step * (index of the segment in the curve) for all segments."""
        number = np.arange(self.segments.sum()) - np.repeat(starts(self.segments), self.segments)
        return np.repeat(first, self.segments) + step * number

    def _with_phantoms(self, values):
        """Adds 2 P0 - P1 before the first vertex of each curve, and its mirror after the last."""
        first = starts(self.sizes)
        padded_first = starts(self.padded)
        padded = np.empty((self.padded.sum(), values.shape[1]))
        inner = np.arange(values.shape[0]) - np.repeat(first, self.sizes)
        padded[np.repeat(padded_first + self.drawn, self.sizes) + inner] = values
        first = first[self.drawn]
        last = first + self.sizes[self.drawn] - 1
        padded_first = padded_first[self.drawn]
        padded[padded_first] = 2 * values[first] - values[first + 1]
        padded[padded_first + self.padded[self.drawn] - 1] = 2 * values[last] - values[last - 1]
        return padded

    def _place(self, weights, corners, points_alone):
        """corners: [segment][corner][component]; weights of the corners: a function of t;
        points_alone: those of curves of one vertex."""
        counts = self.point_counts()
        points = np.empty((counts.sum(), corners.shape[2]))
        first = self._per_segment(starts(counts), self.between + 1)
        for i in range(self.between + 1):
            points[first + i] = np.einsum("c,sck->sk", weights(i / (self.between + 1)), corners)
        last_segments = np.cumsum(self.segments)[self.drawn] - 1
        last_points = np.cumsum(counts)[self.drawn] - 1
        points[last_points] = np.einsum("c,sck->sk", weights(1.0), corners[last_segments])
        points[starts(counts)[self.sizes == 1]] = points_alone
        return points
