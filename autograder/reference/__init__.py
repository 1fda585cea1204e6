"""The reference solver: serial and parallel robots in modified DH, forward and inverse kinematics.

The solver itself is `dhm`, a package of its own (`autograder/solver`); here is the course's face of it, with what belongs
to the course alone: the documents' robots, their determinants and centres, and the errata (`reference.errata`).

Lengths in metres, angles in radians, arrays batch-first: q (..., n), poses (..., 4, 4). Everything that follows is
tested, whether or not a question asks for it.

**Tables.** `DHTable` describes a serial robot, `robots` holds those of the documents; a table comes from classic rows, a
URDF joint list or a URDF file (`table_from_urdf_file`) too, and can be printed (`DHTable.to_markdown`,
`DHTable.to_latex`). Right angles with few digits (1.5708) are read as such, with a `RoundedInput` warning that says how
far off they were.

>>> import numpy as np
>>> from autograder.reference import DHTable, robots
>>> table = DHTable([(0, 0, 0, 0, None), (0, 0.5, 0, 0, None), (0, 0.4, 0, 0, 0)], name="two links")
>>> table.forward([0, np.pi / 2])[:2, 3].round(3)
array([0.5, 0.4])
>>> print(table.to_markdown().splitlines()[2])
| 1 | 0 | $0$ | $0$ | $0$ | $q_{1}$ |
>>> table.symbolic_forward()[0, 3], table.inverse_transform().shape
(0.5*cos(q1) + 0.4*cos(q1 + q2), (4, 4))
>>> table.to_classic().to_modified().rows[1].a
0.500000000000000
>>> DHTable.from_classic([(0, 0.5, 0, 0, None), (0, 0.4, 0, 0, None)]).forward([0, np.pi / 2])[:2, 3].round(3)
array([0.5, 0.4])

**Forward and inverse kinematics.** Every real solution, named by its branch, or why there is none; `status` is one of
the four words of `Status`, in all solvers.

>>> arm = robots.RX90
>>> postures = arm.inverse(arm.forward(np.radians([20, 40, -30, 50, 60, -70])))
>>> len(postures), postures.labels[0]
(8, 'shoulder left, elbow down, wrist unflipped')
>>> robots.PLANAR_2R.inverse([2.0, 0.0]).reason
'the point is 0.4 m beyond the reach 1.6 m'
>>> arm.has_inverse, robots.PUMA_PRINTED.has_inverse
(True, False)

A robot of one's own is `Robot` of its table, whichever senses its axes have: the closed form that fits is chosen, and
`misfits` says what the table lacks for each one.

>>> Robot(table).inverse([0.5, -0.4]).q.round(3)
array([[-1.349,  1.571],
       [ 0.   , -1.571]])
>>> misfits(robots.PUMA_PRINTED.table)["elbow arm with a spherical wrist"]
'axes 5 and 6 are not at a right angle: alpha_5 = 0 degrees'

Arms whose joints hold a group of three (a wrist, three parallel axes), wherever it stands, are solved too: UR arms,
Stanford arms, gantries, and arms of fewer joints that are such an arm with some left out.

>>> half = np.pi / 2
>>> rows = [(0, 0, half, 0.09, None), (0, -0.42, 0, 0, None), (0, -0.39, 0, 0, None)]
>>> rows += [(0, 0, half, 0.11, None), (0, 0, -half, 0.09, None), (0, 0, 0, 0.08, None)]
>>> ur5 = Robot(DHTable.from_classic(rows, name="UR5"))
>>> len(ur5.inverse(ur5.forward([0.3, -1.0, 1.2, 0.4, 0.5, 0.6])))
8
>>> ur5.inverse(ur5.forward([0.3, -1.0, 1.2, 0.4, 0.0, 0.6])).free
'q6 free'

Any other six turns are solved by elimination, up to 16 postures; of seven joints one is named that is free.

>>> bent = [*rows[:2], (0, -0.39, 0.2, 0, None), *rows[3:]]
>>> general = Robot(DHTable.from_classic(bent))
>>> len(general.inverse(general.forward([0.3, -1.0, 1.2, 0.4, 0.5, 0.6])))
8
>>> rail = Robot(DHTable.from_classic([(1, 0, half, None, 0), *rows]))
>>> rail.inverse(rail.forward([0.2, 0.3, -1.0, 1.2, 0.4, 0.5, 0.6])).free
'q1 free'

**Families.** A singular or redundant posture names its free direction; `near` chooses the member that is reported.

>>> aligned = arm.inverse(arm.forward([0.3, 0.4, 0.5, 0.6, 0, 0.7]), near=[0, 0, 0, 1.0, 0, 0.3])
>>> aligned.status, aligned.free_by_row[0]
(<Status.INFINITE: 'infinite'>, 'q4 + q6 = const')
>>> aligned.q[0, [3, 5]].round(3)
array([1. , 0.3])

**Joint limits and the nearest posture.** With ``limits=True`` only postures within the limits count, in every full
turn that they allow; of a family, a member that is within them.

>>> narrow = robots.planar_2r(limits=[(-1.0, 1.0), (0.0, 3.0)])
>>> narrow.inverse(narrow.forward([0.2, 0.9]), limits=True).q.round(3)
array([[0.2, 0.9]])
>>> narrow.nearest(narrow.forward([0.2, 0.9]), q0=[1.0, -1.0]).q.round(3)
array([ 0.86, -0.9 ])

**Jacobian and singularities.** Rank and determinant tell where freedoms are lost, `mobility` whether the table has
them at all.

>>> arm.jacobian([0.3, 0.4, 0.5, 0.6, 0.7, 0.8]).shape, int(rank(arm.table, [0.3, 0.4, 0.5, 0.6, 0, 0.8]))
((6, 6), 5)
>>> mobility(robots.PUMA_PRINTED.table)
5
>>> from sympy import symbols
>>> rx90_determinant(*symbols("a3 d3 t2 t3 t5"))
-a3*d3*(-a3*cos(t2) + d3*sin(t2 + t3))*sin(t5)*cos(t3)

**Workspace.** Clouds of any robot under joint limits, their cross-section and area; exact areas for two links.

>>> half_turn = workspace.RRArm(0.5, 0.4, q1=(0, np.pi), q2=(0, np.pi / 2))
>>> round(half_turn.area(), 4), round(half_turn.sheet_area(), 4), bool(half_turn.contains([0.0, 0.8]))
(0.6283, 0.6283, True)
>>> [round(radius, 4) for radius in half_turn.radii()]
[0.6403, 0.9]
>>> [len(curve) > 1 for curve in half_turn.boundary(step=0.1)]
[True, True, True, True]
>>> workspace.grid(robots.PLANAR_2R, [[-1, 1], [0, 2]], (3, 5)).shape
(3, 5, 3)
>>> ranges = np.array([[-3, 3], [-1, 1], [-2, 0], [0, 0], [0, 0], [0, 0]])
>>> cloud = workspace.cross_section(arm, ranges, 20_000, np.random.default_rng(0))
>>> cloud.shape, bool(workspace.cells(cloud, 0.02).area > 0.3)
((20000, 2), True)

**Equations by type.** The equations of Paul's method, types 1 to 8, each with its degenerate cases.

>>> equations.type2(1.0, 1.0, 1.0).values.round(4)
array([1.5708, 0.    ])
>>> equations.type4(1.0, 0.3, 1.0, 0.4).values[0].round(4)
array([0.6435, 0.5   ])
>>> equations.type7(0.3, 0.4, 0.5, 0.0, 0.2, 0.1).count
array(2)
>>> str(equations.type8(0.5, 0.4, 0.9, 0.0).status)
'boundary'

**Orientation.** Both triples of all twelve Euler sets, moving or fixed axes, and what is left of them at gimbal lock.

>>> lock = orientation.rpy(orientation.rpy_matrix(0.3, np.pi / 2, 0.1))
>>> lock.describe(("roll", "pitch", "yaw"))
'roll - yaw = 0.2 rad, roll + yaw free'

**Parallel robots.** `ThreeRPR` and `ThreeRRR`: the same two words, `forward` and `inverse`.

>>> legs = robots.THREE_RPR.inverse([0.5, 0.4, 0.1])
>>> int(robots.THREE_RPR.forward(legs).count), robots.THREE_RPR.polynomial(legs).shape
(2, (7,))
"""

from dhm import (
    Batch,
    ClassicTable,
    DHRow,
    DHTable,
    Failure,
    Flag,
    Nearest,
    Robot,
    RoundedInput,
    Solutions,
    Status,
    ThreeRPR,
    ThreeRRR,
    UrdfJoint,
    equations,
    jacobian,
    misfits,
    mobility,
    orientation,
    rank,
    table_from_urdf,
    table_from_urdf_file,
    workspace,
)

from . import catalogue as robots
from .centres import epfl_centres, rotation_about, scara_centres
from .determinants import rx90_determinant, scara_determinant, two_link_determinant

__all__ = [
    "Batch",
    "ClassicTable",
    "DHRow",
    "DHTable",
    "Failure",
    "Flag",
    "Nearest",
    "Robot",
    "RoundedInput",
    "Solutions",
    "Status",
    "ThreeRPR",
    "ThreeRRR",
    "UrdfJoint",
    "epfl_centres",
    "equations",
    "jacobian",
    "misfits",
    "mobility",
    "orientation",
    "rank",
    "robots",
    "rotation_about",
    "rx90_determinant",
    "scara_centres",
    "scara_determinant",
    "table_from_urdf",
    "table_from_urdf_file",
    "two_link_determinant",
    "workspace",
]
