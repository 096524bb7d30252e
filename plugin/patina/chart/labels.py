# SPDX-License-Identifier: Apache-2.0
"""Direct labels: names stand beside what they name, where they cover least."""

LINE, STEP = 11.0, 5.0  # height of a label and distance of the points along a line that it may cover, in pixels
GAP = 5.0  # pixels between labels that stand beside each other
AROUND = ((7, -6), (7, 13), (-7, -6), (-7, 13), (0, -9), (0, 17), (9, 4), (-9, 4), (7, -18), (7, 25), (-7, -18), (-7, 25),
          (0, -22), (0, 30), (7, -32), (-7, -32), (7, 40), (-7, 40))


def along(points):
    """:param points: corners of a line, in pixels
    :returns: points along it, near each other"""
    found = list(points[:1])
    for (a, b), (c, d) in zip(points, points[1:]):
        steps = max(1, int(max(abs(c - a), abs(d - b)) / STEP))
        found += [(a + (c - a) * i / steps, b + (d - b) * i / steps) for i in range(1, steps + 1)]
    return found


class Places:
    """Finds a place for one label after the other.

    :param frame: left, top, right, bottom: labels stay inside"""

    def __init__(self, frame):
        self.frame = frame
        self._points, self._boxes = [], []

    def cover(self, points):
        """Labels should not stand on these points."""
        self._points += points

    def take(self, box):
        """Labels should not stand on this box: left, top, right, bottom."""
        self._boxes.append(box)

    def _cost(self, box):
        left, top, right, bottom = box
        outside = max(0.0, self.frame[0] - left, right - self.frame[2], self.frame[1] - top, bottom - self.frame[3])
        met = sum(left - 1 < x < right + 1 and top - 1 < y < bottom + 1 for x, y in self._points)
        over = sum(left < c + GAP and a < right + GAP and top < d and b < bottom for a, b, c, d in self._boxes)
        return 1e4 * (outside > 0.0) * (1.0 + outside) + 400.0 * over + met

    def place(self, anchors, room):
        """:param anchors: points that the label may stand beside, the best first
        :param room: the label's width, in pixels
        :returns: (x, y, text-anchor, the point) of its baseline; its box is taken"""
        best = None
        for rank, (x, y) in enumerate(anchors):
            for i, (dx, dy) in enumerate(AROUND):
                anchor = "middle" if dx == 0 else "start" if dx > 0 else "end"
                left = x + dx - (room / 2 if dx == 0 else 0.0 if dx > 0 else room)
                box = (left, y + dy - LINE + 2, left + room, y + dy + 2)
                cost = self._cost(box) + 0.15 * rank + 0.4 * i
                if best is None or cost < best[0]:
                    best = (cost, x + dx, y + dy, anchor, (x, y), box)
        self.take(best[5])
        return best[1:5]
