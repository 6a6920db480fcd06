"""What the examples claim, as ranges of the figures that they print: name, least, greatest."""

INFINITY = float("inf")
NONE = (0.0, 0.0)

# Obstacles and waypoints of the paper's examples.
PAST_OBSTACLES = {
    "waypoint 1 reached after": (10.0, 13.0),
    "waypoint 2 reached after": (20.0, 25.0),
    "least distance to obstacle_a": (0.18, 0.1801),
    "samples nearer than 0.18 m to obstacle_a": NONE,
    "least distance to obstacle_b": (0.15, 0.1501),
    "samples nearer than 0.15 m to obstacle_b": NONE,
}

#: Those that are there in Rust and in Python, and print the same.
PAIRS = {
    "01_position": {
        "distance at the start": (0.8, 0.9),
        # Within half a percent of the exponential, which is printed too.
        "distance after 4 s": (0.1116, 0.1128),
        "distance by exp(-gain t) after 4 s": (0.1122, 0.1122),
        "nearer than 1 mm after": (13.0, 14.0),
        "furthest from the straight line": (0.0, 2.0),
    },
    "02_obstacle": {
        **PAST_OBSTACLES,
        "changes of what is held": (4, 4),
        "left to the last waypoint": (0.0, 0.01),
        "left of the view": (0.0, 1e-4),
    },
    "03_field_of_view": {
        **PAST_OBSTACLES,
        "view at the start": (0.8, 0.9),
        "view entered after": (3.0, 5.0),
        "greatest view from then on": (0.2621, 0.2622),
        "samples outside the view from then on": NONE,
        "time in which the view is held": (40.0, 60.0),
        "changes of what is held": (5, 5),
    },
    "04_low_priority": {
        **PAST_OBSTACLES,
        "view at the start": (0.8, 0.9),
        "view entered after": (3.0, 5.0),
        # Samples may lie outside, and do, by little.
        "greatest view from then on": (0.2622, 0.263),
        "samples outside the view from then on": (1, INFINITY),
        "view at the end": (0.262199, 0.262201),
        "time in which the view is active": (40.0, 60.0),
        "changes of what is active": (5, 5),
    },
    "05_own_task": {
        "lean at the start": (-4.7, -4.6),
        "least lean": (-4.8, -4.79),
        "greatest lean": (-4.31, -4.3),
        "samples outside": NONE,
        "time in which the lean is held": (5.0, 10.0),
        "left to the target": (0.0, 0.1),
    },
    "06_moving_obstacle": {
        **{
            figure: claim
            for told in ("velocity told", "velocity not told")
            for figure, claim in {
                f"{told}, waypoint 1 reached after": (10.0, 16.0),
                f"{told}, waypoint 2 reached after": (20.0, 27.0),
                f"{told}, time in which the ball is held off": (1.0, 2.0),
            }.items()
        },
        "velocity told, samples inside the ball": NONE,
        "velocity told, deepest inside the ball": NONE,
        "velocity not told, samples inside the ball": (1, INFINITY),
        # One period of the ball's motion.
        "velocity not told, deepest inside the ball": (1.0, 1.7),
    },
}

SETS_OF_MUJOCO = ("obstacle_a", "obstacle_b", "view")

#: Those in Python alone, and their claims.
PYTHON = {
    "10_mujoco": {
        "MuJoCo and Conik place the tool apart by": (0.0, 1e-12),
        **{
            figure: claim
            for title in ("bounds as they are", "bounds with a margin")
            for figure, claim in {
                f"{title}, waypoint 1 reached by the arm after": (10.0, 13.0),
                f"{title}, waypoint 2 reached by the arm after": (20.0, 25.0),
                f"{title}, greatest lag of a joint": (0.1, 2.0),
                f"{title}, greatest lag of the tool": (0.5, 10.0),
                **{f"{title}, references outside {name}": NONE for name in SETS_OF_MUJOCO},
            }.items()
        },
        # The arm itself leaves sets, by less than a tenth of a millimetre; with a margin it does not.
        "bounds as they are, arm outside obstacle_a": (0.001, 0.1),
        "bounds as they are, arm outside obstacle_b": (0.001, 0.1),
        "bounds as they are, arm outside view": (0.0, 1e-3),
        **{f"bounds with a margin, arm outside {name}": NONE for name in SETS_OF_MUJOCO},
    },
    "11_pinocchio": {
        "joints": (7, 7),
        "poses of the tool differ at most by": (0.0, 1e-12),
        "Jacobians of the tool differ at most by": (0.0, 1e-12),
        "elbow at the start": (0.65, 0.66),
        "lowest the elbow was": (0.6, 0.601),
        "lowest the tool was": (0.02, 0.0201),
        # The target is 20 mm below the floor.
        "left to the target": (20.0, 20.01),
        "left to look straight down": (0.0, 5.0),
    },
    "12_rerun": {
        "ticks": (7501, 7501),
        "drawings of the arm": (1501, 1501),
        "size": (0.5, 10.0),
    },
    "14_from_pink": {
        "least y": (-0.4, -0.399),
        "greatest y": (0.599, 0.6),
        "samples outside the walls": NONE,
        "time at a wall": (5.0, 15.0),
        "median error while no wall is in the way": (0.0, 1.0),
        "greatest error of the orientation": (0.0, 1.0),
    },
    "15_from_mink": {
        "looks off the target before it moves by": (0.0, 3.0),
        "furthest off the target": (0.0, 3.0),
        "samples more than 3 deg off": NONE,
        "time in which the view is held": (1.0, 7.0),
        "greatest speed of a joint": (0.0, 180.0),
        "furthest from the posture": (1.0, 90.0),
    },
}


def figures(text):
    """What an example printed: each line has a name and a figure, and a unit where it has one."""
    found = {}
    for line in text.splitlines():
        name, separator, rest = line.rpartition(": ")
        if not separator or name in found:
            raise ValueError(f"no figure, or a second one of that name: {line!r}")
        found[name] = float(rest.split()[0])
    return found


def broken(found, claims):
    """What does not hold of some figures, in words."""
    wrong = [f"`{name}` is printed but claimed nowhere" for name in found.keys() - claims.keys()]
    for name, (least, greatest) in claims.items():
        if name not in found:
            wrong.append(f"`{name}` is not printed")
        elif not least <= found[name] <= greatest:
            wrong.append(f"`{name}` is {found[name]}, not from {least} to {greatest}")
    return wrong
