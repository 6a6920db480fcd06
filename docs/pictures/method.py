"""Draws the pictures of docs/method-in-pictures.md: `pip install . matplotlib; python docs/pictures/method.py`.

Curves are runs of the package; the sketches of velocities are computed from their definitions. Colours are told
apart by everybody, and nothing is told by colour alone.
"""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

import conik

PICTURES = Path(__file__).resolve().parent
SCENARIOS = PICTURES.parent.parent / "scenarios"
ORANGE, BLUE, GREEN, PURPLE = "#d55e00", "#0072b2", "#009e73", "#cc79a7"
INK, GREY, PALE = "#222222", "#777777", "#dddddd"
FORBIDDEN = {"facecolor": "#f3e3d7", "edgecolor": "#c9a185", "hatch": "///", "linewidth": 0}
START = {"model": "ur5-paper", "q0_deg": [-48, -158, -108, -90, -85, 0]}
BALL = {"name": "ball", "type": "distance", "point_m": [0.40, -0.25, -0.33], "min": 0.18}
GOAL = {"name": "goal", "type": "position", "target_m": [0.486, -0.066, -0.250], "gain_per_s": 0.5}

plt.rcParams.update(
    {
        "axes.edgecolor": GREY,
        "axes.labelcolor": INK,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "axes.titlesize": 11,
        "figure.facecolor": "white",
        "font.size": 10,
        "hatch.linewidth": 0.6,
        "savefig.facecolor": "white",
        "svg.hashsalt": "conik",
        "xtick.color": GREY,
        "ytick.color": GREY,
    }
)


def save(figure, name):
    figure.savefig(PICTURES / f"method-{name}.svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    plt.close(figure)


def run(tasks, **control):
    return conik.run({"robot": START, "control": control, "task": tasks})


def set_and_border():
    """The distance to a ball over time, with the set and without it."""
    kept = run([BALL, GOAL], duration_s=10)
    start = START["model"], np.radians(START["q0_deg"])
    robot, q = conik.Robot.builtin(start[0]), start[1]
    stack = conik.Stack(robot)
    stack.equality("goal", conik.Position(GOAL["target_m"]), gain=GOAL["gain_per_s"])
    controller, free = conik.Controller(robot, stack), []
    for _ in range(len(kept)):
        tool = robot.forward_kinematics(q)[:3, 3]
        free.append(np.linalg.norm(tool - BALL["point_m"]))
        q = controller.step(q).q_ref

    figure, axes = plt.subplots(figsize=(7.4, 3.3))
    axes.axhspan(0, 0.18, **FORBIDDEN)
    axes.axhline(0.18, color=INK, linewidth=1)
    held = kept.is_active("ball")
    axes.plot(kept.t_s, free, color=GREY, linestyle="--", linewidth=1.4, label="without the set")
    axes.plot(kept.t_s, kept["ball"], color=INK, linewidth=1.6, label="with the set")
    axes.plot(kept.t_s[held], kept["ball"][held], color=ORANGE, linewidth=4, solid_capstyle="butt", label="held")
    axes.text(9.9, 0.174, "not allowed", ha="right", va="top", color=INK)
    axes.text(9.9, 0.183, "border: 0.18 m", ha="right", va="bottom", color=INK)
    axes.set(xlim=(0, 10), ylim=(0.04, 0.28), xlabel="time [s]", ylabel="distance to the ball [m]")
    axes.legend(frameon=False, loc="upper center", ncols=3)
    save(figure, "set")


def arrow(axes, tail, tip, color, **more):
    style = {"arrowstyle": "-|>,head_width=0.3,head_length=0.6", "color": color, "linewidth": 2, "shrinkA": 0}
    style |= {"shrinkB": 0} | more
    axes.annotate("", xy=tip, xytext=tail, arrowprops=style)


def tangent_cone():
    """Where the value is, and which way it may go."""
    figure, rows = plt.subplots(3, 1, figsize=(7.4, 3.0))
    cases = [("inside: any way", 0.5, (-1, 1)), ("at the border: not out", 0.0, (1,)), ("outside: not further out", -0.28, (1,))]
    for axes, (title, at, ways) in zip(rows, cases, strict=True):
        axes.add_patch(plt.Rectangle((-0.5, -0.16), 0.5, 0.32, **FORBIDDEN))
        axes.add_patch(plt.Rectangle((1.0, -0.16), 0.5, 0.32, **FORBIDDEN))
        axes.plot([-0.5, 1.5], [0, 0], color=GREY, linewidth=1)
        for bound in (0, 1):
            axes.plot([bound, bound], [-0.22, 0.22], color=INK, linewidth=1.5)
        for way in (-1, 1):
            if way in ways:
                arrow(axes, (at, 0), (at + 0.3 * way, 0), BLUE)
            else:
                arrow(axes, (at, 0), (at + 0.17 * way, 0), PALE)
                axes.plot(at + 0.1 * way, 0, marker="x", color=ORANGE, markersize=9, markeredgewidth=2.5, zorder=4)
        axes.plot(at, 0, "o", color=INK, markersize=8, zorder=5)
        axes.text(1.6, 0, title, va="center", color=INK)
        axes.set(xlim=(-0.52, 2.7), ylim=(-0.35, 0.35))
        axes.axis("off")
    rows[0].text(0, 0.28, "min", ha="center", va="bottom", color=INK)
    rows[0].text(1, 0.28, "max", ha="center", va="bottom", color=INK)
    save(figure, "cone")


def plane(axes, title):
    axes.axhline(0, color=PALE, linewidth=1, zorder=0)
    axes.axvline(0, color=PALE, linewidth=1, zorder=0)
    axes.set(xlim=(-1.15, 1.5), ylim=(-1.15, 1.5), aspect="equal", xticks=[], yticks=[], title=title)
    axes.set_xlabel("velocity of joint 1", color=GREY)


def half_plane(axes, normal, bound):
    """Forbids velocities v with normal · v < bound."""
    normal = np.asarray(normal, float) / np.linalg.norm(normal)
    along = np.array([-normal[1], normal[0]])
    foot = bound * normal
    corners = [foot - 4 * along, foot + 4 * along, foot + 4 * along - 4 * normal, foot - 4 * along - 4 * normal]
    axes.add_patch(plt.Polygon(corners, closed=True, **FORBIDDEN, zorder=-1))
    axes.plot(*np.transpose(corners[:2]), color=INK, linewidth=1.2)


def modes():
    """Which sets have to be held depends on what is asked."""
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.3))
    first, second = np.array([0.35, 0.94]), np.array([0.94, -0.35])
    first, second = first / np.linalg.norm(first), second / np.linalg.norm(second)
    for axes, asked, title in zip(
        panels,
        [np.array([0.55, 0.9]), np.array([1.05, -0.7]), np.array([-0.75, -0.65])],
        ["nothing held", "a held", "a and b held"],
        strict=True,
    ):
        plane(axes, title)
        half_plane(axes, first, -0.12)
        half_plane(axes, second, -0.12)
        taken = asked.copy()
        if first @ asked < -0.12:
            taken = asked - (first @ asked + 0.12) * first
        if second @ taken < -0.12:
            taken = np.linalg.solve(np.array([first, second]), [-0.12, -0.12])
        if not np.allclose(taken, asked):
            axes.plot(*np.transpose([asked, taken]), color=GREY, linestyle=":", linewidth=1.5)
            axes.plot(*asked, "o", markerfacecolor="white", markeredgecolor=GREY, markersize=8)
            axes.text(*(asked + [0.0, -0.12]), "asked", ha="center", va="top", color=INK)
        arrow(axes, (0, 0), taken, BLUE)
        offset = [0.08, 0.08] if taken[0] > 0.2 else [0.12, 0.16]
        axes.text(*(taken + offset), "taken", ha="left", va="bottom", color=BLUE)
        axes.text(-1.08, 0.55, "b", color=INK, fontsize=12, fontweight="bold")
        axes.text(0.42, -1.05, "a", color=INK, fontsize=12, fontweight="bold")
    panels[0].set_ylabel("velocity of joint 2", color=GREY)
    save(figure, "modes")


def priorities():
    """Strict order, and weights."""
    figure, (strict, weighted) = plt.subplots(1, 2, figsize=(7.4, 3.6))
    normal = np.array([0.5, 0.866])
    offset, wish = 0.85, np.array([-0.5, -0.55])
    line = np.array([offset * normal + t * np.array([-0.866, 0.5]) for t in (-3, 3)])
    for axes, title in ((strict, "in strict order"), (weighted, "with weights")):
        plane(axes, title)
        axes.plot(*line.T, color=INK, linewidth=1.6)
        axes.text(1.01, 0.53, "task 1: any of these", color=INK, ha="center", rotation=-30, rotation_mode="anchor")
        axes.plot(*wish, "s", color=PURPLE, markersize=8)
        axes.text(wish[0] + 0.1, wish[1], "task 2: this one", color=INK, va="center")
    taken = wish + (offset - normal @ wish) * normal
    strict.plot(*np.transpose([wish, taken]), color=GREY, linestyle=":", linewidth=1.5)
    strict.plot(*taken, "o", color=BLUE, markersize=9, zorder=4)
    strict.text(taken[0] - 0.12, taken[1] - 0.06, "taken", color=BLUE, ha="right", va="center")
    for weight in (1, 3, 10):
        # The least weight (n v - offset)² + |v - wish|².
        v = np.linalg.solve(weight * np.outer(normal, normal) + np.eye(2), weight * offset * normal + wish)
        weighted.plot(*v, "o", color=ORANGE, markersize=9, zorder=4)
        weighted.text(v[0] - 0.1, v[1], f"{weight}:1", color=INK, ha="right", va="center")
    strict.set_ylabel("velocity of joint 2", color=GREY)
    save(figure, "priorities")


def example2():
    """Which sets are held when in Example 2."""
    done = conik.run(SCENARIOS / "paper" / "example2.toml")
    names = ["obstacle_a", "obstacle_b", "view"]
    figure, axes = plt.subplots(figsize=(7.4, 2.2))
    for row, (name, color) in enumerate(zip(names, (ORANGE, BLUE, GREEN), strict=True)):
        axes.plot([0, 60], [-row, -row], color=PALE, linewidth=1, zorder=0)
        held = done.is_active(name)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], held.astype(int), [0]])))
        for begin, end in zip(edges[::2], edges[1::2], strict=True):
            axes.barh(-row, (end - begin) / 125, left=begin / 125, height=0.6, color=color)
    changes = np.flatnonzero(np.diff(done.active)) + 1
    for change in changes:
        axes.axvline(change / 125, color=GREY, linewidth=0.8, linestyle=":")
    axes.set(xlim=(0, 60), ylim=(-2.6, 0.6), yticks=[0, -1, -2], yticklabels=names, xlabel="time [s]")
    axes.tick_params(axis="y", length=0, labelcolor=INK)
    save(figure, "example2")


def land():
    """What happens between samples, at 5 Hz so that it is seen."""
    figure, axes = plt.subplots(figsize=(7.4, 3.3))
    axes.axhspan(-30, 0, **FORBIDDEN)
    axes.axhline(0, color=INK, linewidth=1)
    for border, color, marker in (("freeze", ORANGE, "s"), ("land", BLUE, "o")):
        done = run([BALL, GOAL], rate_hz=5, duration_s=4, border=border)
        depth = 1e3 * (done["ball"] - 0.18)
        print(f"border {border} at 5 Hz: {-min(depth.min(), 0):.2f} mm outside")
        axes.plot(done.t_s, depth, color=color, marker=marker, markersize=6, linewidth=1, label=f"border {border}")
    axes.text(3.95, -19, "not allowed", ha="right", va="bottom", color=INK)
    axes.set(xlim=(0, 4), ylim=(-20, 30), xlabel="time [s]", ylabel="way left to the ball [mm]")
    axes.legend(frameon=False, loc="upper center")
    save(figure, "land")


if __name__ == "__main__":
    for picture in (set_and_border, tangent_cone, modes, priorities, example2, land):
        picture()
