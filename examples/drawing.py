"""How the pictures of the examples look: colours, the way of the tool, values over time. Needs matplotlib.

Colours are those of Okabe and Ito, which people who see red and green alike can tell apart.
"""

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, GREY = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#D55E00",
    "#CC79A7",
    "#56B4E9",
    "#666666",
)
# Samples between two points of a drawn line: at 125 Hz, more cannot be seen.
STRIDE = 8


def figure(title, height=4.4):
    """An empty figure as wide as a page."""
    plt.rcParams.update(
        {
            "font.size": 9,
            "legend.fontsize": 8,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "axes.axisbelow": True,
            "grid.color": "#DDDDDD",
            "grid.linewidth": 0.6,
            "legend.frameon": False,
            # The same picture from the same figures, to the byte.
            "svg.hashsalt": "conik",
        }
    )
    drawn = plt.figure(figsize=(9.0, height), layout="constrained")
    drawn.suptitle(title, fontsize=10)
    return drawn


def figure_of_run(title, values=2, height=4.8):
    """A figure with the way of the tool on the left, and plots over one time axis on the right: the figure,
    the `Way`, a list of plots."""
    drawn = figure(title, height)
    left, right = drawn.subfigures(1, 2, width_ratios=(1.0, 1.25))
    plots = right.subplots(values, 1, sharex=True, squeeze=False)[:, 0]
    plots[-1].set_xlabel("time [s]")
    return drawn, Way(left), list(plots)


class Way:
    """What happens in space, seen from above and from the side. Lengths are in metres."""

    def __init__(self, part):
        self.part = part
        self.above, self.side = part.subplots(2, 1, sharex=True)
        self.above.set(ylabel="x [m], from above", aspect="equal")
        # The world's z axis is up; from above, x is drawn downwards, so that nothing is mirrored.
        self.above.invert_yaxis()
        self.side.set(xlabel="y [m]", ylabel="z [m], from the side", aspect="equal")

    def line(self, points, label, color=BLUE, **line):
        """The way of a point, shape (ticks, 3)."""
        points = thin(points)
        self.above.plot(points[:, 1], points[:, 0], color=color, label=label, **line)
        self.side.plot(points[:, 1], points[:, 2], color=color, **line)

    def marks(self, points, label, marker="x", color="black", numbered=False):
        """Single points, with numbers if asked for."""
        for number, point in enumerate(np.atleast_2d(points), 1):
            for axes, seen in ((self.above, (point[1], point[0])), (self.side, (point[1], point[2]))):
                line = {"color": color, "linestyle": "none", "zorder": 3}
                axes.plot(*seen, marker, label=label if axes is self.above else None, **line)
                if numbered:
                    axes.annotate(str(number), seen, xytext=(5, 5), textcoords="offset points")
            label = None

    def sphere(self, center, radius, label=None, color=VERMILION, alpha=0.2):
        """A sphere that must not be entered. The tool may be above or beside it where it is drawn inside."""
        x, y, z = center
        style = {"facecolor": color, "alpha": alpha, "edgecolor": color}
        self.above.add_patch(plt.Circle((y, x), radius, label=label, **style))
        self.side.add_patch(plt.Circle((y, z), radius, **style))

    def finish(self, height=0.3, columns=3):
        """Says below both views what is what; each is at least so high [m]."""
        for axes in (self.above, self.side):
            low, high = axes.get_ylim()
            missing = max(0.0, height - abs(high - low)) / 2.0
            axes.set_ylim(low - np.sign(high - low) * missing, high + np.sign(high - low) * missing)
        handles, labels = self.above.get_legend_handles_labels()
        self.part.legend(handles, labels, loc="outside lower center", ncols=columns)


def thin(values):
    """Every so many samples, and the last."""
    values = np.asarray(values)
    return np.concatenate([values[:-1:STRIDE], values[-1:]])


def value_over_time(axes, t, values, label, color=BLUE, **line):
    """One value of each tick over time [s]."""
    axes.plot(thin(t), thin(values), color=color, label=label, **line)


def bound(axes, value, label=None, color="black"):
    """A border of a set."""
    axes.axhline(value, color=color, linestyle="--", linewidth=1.0, label=label)


def active(axes, t, is_active, label=None, color=ORANGE):
    """Shades the times at which a set is active."""
    t, is_active = np.asarray(t), np.asarray(is_active, dtype=bool)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], is_active, [False]]).astype(int)))
    for begin, end in zip(edges[::2], edges[1::2]):
        axes.axvspan(t[begin], t[min(end, len(t) - 1)], color=color, alpha=0.25, linewidth=0, label=label)
        label = None


def legend_above(axes, columns=4):
    """A legend over the plot, where it hides no line."""
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, borderaxespad=0.2)


def save(drawn, path):
    """Writes the picture; the ending of the path says what kind."""
    is_svg = str(path).endswith(".svg")
    drawn.savefig(path, dpi=110, metadata={"Date": None} if is_svg else None)
    plt.close(drawn)
