"""Points on the curves of UsdGeomNurbsCurves, by their orders, knots, ranges and weights."""

import numpy as np

from usd_cubic import starts

MOST_ORDER = 16


class NurbsCurves:
    """Curves with knots, with the interface of CubicCurves. A segment is an interval between two
    different successive knots, within the curve's range. All segments have as many points, even in
    the parameter: the fewest that give no curve fewer points than vertices, but no more of them
    than the order of its curve asks for. A curve of one vertex is a point, and one of none has none."""

    def __init__(self, sizes, orders, knots, ranges=None, weights=None):
        """`sizes`, `orders` and `ranges` (2 columns) have a row for each curve, or the last two
        one for all; `knots` are those of all curves, as many for each as its vertices and its
        order. Raises ValueError for invalid curves."""
        self.sizes = np.asarray(sizes, np.int64)
        self.orders = self._orders(orders)
        self.knots = self._knots(np.asarray(knots, np.float64))
        self.weights = self._weights(weights)
        self._find_segments(self._ranges(ranges))
        pieces = np.minimum(-(-(self.sizes - 1) // np.maximum(self.segments, 1)), self.orders - 1)
        self.between = int(np.max(pieces, initial=1)) - 1

    def point_counts(self):
        return np.where(self.sizes == 0, 0, self.segments * (self.between + 1) + 1)

    def ends(self):
        """Returns the number of ends of segments of each curve."""
        return np.where(self.sizes == 0, 0, self.segments + 1)

    def vertex(self, values):
        """Returns points from one value (row) for each vertex."""
        values = np.asarray(values, np.float64)
        if self.weights is None:
            return self._place(lambda at: self._sum(values, at), values[self._alone(self.sizes)])
        rational = np.column_stack([values * self.weights[:, None], self.weights])

        def quotient(at):
            sums = self._sum(rational, at)
            return sums[:, :-1] / sums[:, -1:]

        return self._place(quotient, values[self._alone(self.sizes)])

    def varying(self, values):
        """Returns points by linear interpolation of one value for each end of a segment."""
        number = np.arange(self.curve.size) - starts(self.segments)[self.curve]
        first = starts(self.ends())[self.curve] + number

        def between(at):
            return (1 - at) * values[first] + at * values[first + 1]

        return self._place(between, np.asarray(values)[self._alone(self.ends())])

    def _alone(self, counts):
        """Returns the places of curves of one vertex among values, of which curves have `counts`."""
        return starts(counts)[self.sizes == 1]

    # ---- Checks ----

    def _orders(self, orders):
        orders = np.atleast_1d(np.asarray(orders, np.int64))
        if orders.size == 1:
            orders = np.broadcast_to(orders, self.sizes.shape)
        if orders.size != self.sizes.size:
            raise ValueError(f"{orders.size} orders of {self.sizes.size} curves")
        short = (self.sizes < orders) & (self.sizes > 1)
        wrong = np.flatnonzero((orders < 2) | (orders > MOST_ORDER) | short)
        if wrong.size:
            curve = wrong[0]
            raise ValueError(
                f"curve {curve} has the order {orders[curve]} and {self.sizes[curve]} vertices; "
                f"expected an order from 2 to {MOST_ORDER}, and as many vertices"
            )
        return orders

    def _knots(self, knots):
        counts = self.sizes + self.orders
        if knots.shape != (counts.sum(),):
            raise ValueError(
                f"{knots.size} knots, but {counts.sum()} are needed: for each curve as many as its "
                "vertices and its order"
            )
        self.first_knot = starts(counts)
        self.curve_of_knot = np.repeat(np.arange(counts.size), counts)
        wrong = np.flatnonzero(~np.isfinite(knots))
        if wrong.size:
            raise ValueError(f"knot {wrong[0]} is not finite")
        falls = np.flatnonzero(
            (np.diff(knots) < 0) & (np.diff(self.curve_of_knot) == 0) if knots.size else []
        )
        if falls.size:
            raise ValueError(f"curve {self.curve_of_knot[falls[0]]} has knots that decrease")
        return knots

    def _weights(self, weights):
        if weights is None or len(weights) == 0:
            return None
        weights = np.asarray(weights, np.float64)
        if weights.shape != (self.sizes.sum(),):
            raise ValueError(f"{weights.size} weights of {self.sizes.sum()} vertices")
        wrong = np.flatnonzero(~(np.isfinite(weights) & (weights > 0)))
        if wrong.size:
            raise ValueError(f"weight {wrong[0]} is not a positive number")
        return None if (weights == 1).all() else weights

    def _ranges(self, ranges):
        """Returns the range of each curve; without one, it is where the curve is defined."""
        least = self.knots[self.first_knot + self.orders - 1]
        most = self.knots[self.first_knot + self.sizes]
        if ranges is None or len(ranges) == 0:
            return least, most
        ranges = np.asarray(ranges, np.float64).reshape(-1, 2)
        if len(ranges) == 1:
            ranges = np.broadcast_to(ranges, (self.sizes.size, 2))
        if len(ranges) != self.sizes.size:
            raise ValueError(f"{len(ranges)} ranges of {self.sizes.size} curves")
        if not np.isfinite(ranges).all():
            raise ValueError("a range is not finite")
        return np.maximum(ranges[:, 0], least), np.minimum(ranges[:, 1], most)

    # ---- Segments ----

    def _find_segments(self, ranges):
        place = np.arange(self.knots.size) - self.first_knot[self.curve_of_knot]
        curve = self.curve_of_knot
        following = np.append(self.knots[1:], 0.0)[: self.knots.size]
        least = np.maximum(self.knots, ranges[0][curve])
        most = np.minimum(following, ranges[1][curve])
        is_segment = (place >= self.orders[curve] - 1) & (place < self.sizes[curve]) & (least < most)
        self.knot = np.flatnonzero(is_segment)  # of each segment, the knot at or before it
        self.curve = curve[self.knot]
        self.least = least[self.knot]
        self.most = most[self.knot]
        self.segments = np.bincount(self.curve, minlength=self.sizes.size)
        empty = np.flatnonzero((self.segments == 0) & (self.sizes > 1))
        if empty.size:
            raise ValueError(f"curve {empty[0]} has no different knots within its range")

    def _sum(self, values, at):
        """Returns a point of each segment at `at`, from 0 to 1 (Piegl and Tiller 1997, The NURBS
        Book, algorithm A2.2)."""
        points = np.empty((self.knot.size, values.shape[1]))
        parameter = (1 - at) * self.least + at * self.most
        first_vertex = starts(self.sizes)[self.curve] + self.knot - self.first_knot[self.curve]
        for order in np.unique(self.orders[self.curve]):
            own = np.flatnonzero(self.orders[self.curve] == order)
            knot, t = self.knot[own], parameter[own]
            weights = np.zeros((order, own.size))
            weights[0] = 1
            for degree in range(1, order):
                saved = np.zeros(own.size)
                for r in range(degree):
                    right = self.knots[knot + r + 1]
                    left = self.knots[knot + r + 1 - degree]
                    part = weights[r] / (right - left)
                    weights[r] = saved + (right - t) * part
                    saved = (t - left) * part
                weights[degree] = saved
            vertex = first_vertex[own] - (order - 1)
            points[own] = sum(weights[r][:, None] * values[vertex + r] for r in range(order))
        return points

    def _place(self, points_at, alone):
        """Returns all points, from a function that gives a point of each segment. `alone` are the
        points of curves of one vertex."""
        counts = self.point_counts()
        number = np.arange(self.curve.size) - starts(self.segments)[self.curve]
        first = starts(counts)[self.curve] + (self.between + 1) * number
        ends = points_at(1.0)
        points = np.empty((counts.sum(), ends.shape[1]))
        for i in range(self.between + 1):
            points[first + i] = points_at(i / (self.between + 1))
        last, has_segments = np.cumsum(counts) - 1, self.segments > 0
        points[last[has_segments]] = ends[(np.cumsum(self.segments) - 1)[has_segments]]
        points[last[self.sizes == 1]] = alone
        return points
