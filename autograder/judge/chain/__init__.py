"""Whether two modified DH tables describe the same chain of joints, and what they then differ in.

The convention leaves much free: the sense of a Z axis, the sense of X where axes meet, the place of O along parallel
axes, the zero of a joint, base and tool frame. Two tables are of the same chain when there are signs s, offsets o and
constant frames B, E with::

    T_ref(s q + o) = B T(q) E        for all q

A worked example
----------------
The reference, a SCARA without its wrist that stands on the floor (metres and radians):

===  =====  ===  =====  ===  =====
row  sigma  a    alpha  d    theta
===  =====  ===  =====  ===  =====
1    0      0    0      0.4  q1
2    0      0.3  0      0    q2
3    1      0.2  0      d3   0
===  =====  ===  =====  ===  =====

A student starts at the shoulder, lets Z2 point down, and takes for zero the elbow bent by 90 degrees:

===  =====  ===  =====  ===  =========
row  sigma  a    alpha  d    theta
===  =====  ===  =====  ===  =========
1    0      0    0      0    q1
2    0      0.3  pi     0    pi/2 - q2
3    1      0.2  pi     d3   0
===  =====  ===  =====  ===  =========

>>> import numpy as np
>>> from sympy import pi, symbols
>>> from autograder.reference import DHTable
>>> q1, q2, d3 = symbols("q1 q2 d3")
>>> floor = DHTable([(0, 0, 0, 0.4, q1), (0, 0.3, 0, 0, q2), (1, 0.2, 0, d3, 0)])
>>> shoulder = DHTable([(0, 0, 0, 0, q1), (0, 0.3, pi, 0, pi / 2 - q2), (1, 0.2, pi, d3, 0)])
>>> reference, student = JudgedChain.of_table(floor), JudgedChain.of_table(shoulder)

It is the same chain: q2 of the reference is ``q2 - pi/2`` of the student's, and B lifts the base by 0.4 m. The joint
variables keep their sense, because the student wrote ``-q2`` when turning Z2 round.

>>> match = same_chain(student, reference)
>>> match.equal, [str(used) for used in match.freedoms]
(True, ['base frame', 'sense of Z2', 'zero of joint 2'])
>>> match.senses, match.offsets[0].round(4) + 0.0
((1, 1, 1), array([ 0.    , -1.5708,  0.    ]))
>>> match.base[0, :3, 3].round(4)
array([0. , 0. , 0.4])
>>> q = np.array([0.3, -0.8, 0.1])
>>> np.allclose(floor.forward(q + match.offsets[0]), match.base[0] @ shoulder.forward(q) @ match.tool[0])
True

A question that asks for T itself pins base, tool and joint variables. Then the fewest of them are named that explain
the difference, here one, since all axes are parallel: the lift and the turn may as well be put into the tool. A wrong
length is no freedom at all:

>>> same_chain(student, reference, pinned=SAME_MODEL).remarks
('the same chain, but with another tool frame',)
>>> long = DHTable([(0, 0, 0, 0, q1), (0, 0.35, pi, 0, pi / 2 - q2), (1, 0.2, pi, d3, 0)])
>>> same_chain(JudgedChain.of_table(long), reference).remarks
('joint 2: distance between axes 1 and 2 0.35 instead of 0.3',)

How it is found
---------------
Put both chains in their zero posture. Every link k (0 the base, n the hand) must be carried onto link k of the
reference by a rigid motion A_k, such that joint i, which sits on links i-1 and i, is carried by both onto joint i,
up to its sense, and A_{i-1} differs from A_i by a motion of that joint: ``A_{i-1} = motion(o_i) A_i``.
Then ``B = A_0`` and ``E = T(0)^-1 A_n^-1 T_ref(0)``.

Links joined by prismatic joints turn alike, so the rotations are those of `segments`, the stretches between
successive revolute joints. Here there are three: the base, link 1, and link 2 with the quill.

>>> from autograder.judge.chain.alignment import align
>>> from autograder.judge.chain.freedoms import Pins
>>> from autograder.judge.chain.segments import segments
>>> for segment in segments(reference.prismatic):
...     print(segment)
Segment(entry=None, sliders=(), exit=0)
Segment(entry=0, sliders=(), exit=1)
Segment(entry=1, sliders=(2,), exit=None)

`rotations` lists the candidates of each segment: at most four where two directions of it are not parallel or two
parallel axes stand apart (link 1: as it is, or turned by 180 degrees about the line from axis 1 to axis 2), else
those of its neighbours. `shifts` asks what a candidate makes of the places of the axes, which is linear in how far
O_i lands beyond O_i on its axis. `alignment` takes the shortest path through the candidates, where each freedom has
a price; the work is linear in the number of joints. For our two tables the last links are turned by +90 degrees:

>>> found = align(student, reference, np.zeros(3, int), Pins(()).as_wall, 1e-6)
>>> found.senses, found.cost
(array([ 1, -1,  1]), 5.5)
>>> np.degrees(np.arctan2(found.rotations[0, :, 1, 0], found.rotations[0, :, 0, 0])).round()
array([ 0.,  0., 90., 90.])
>>> found.shifts[0].round(4) + 0.0
array([[ 0. ,  0. ,  0.4],
       [ 0. ,  0. ,  0.4],
       [ 0.3, -0.3,  0.4],
       [ 0.3, -0.3,  0.4]])

The price is 2.5 for the base frame, 2 for the zero of joint 2 and 1 for the sense of Z2. `parting` says in words
where the path ends when there is none.

Modules: `frames` (a table as frames on joint axes), `freedoms`, `segments`, `problem`, `rotations`, `shifts`, `linear`,
`alignment`, `parting`, `compare`.
"""

from .compare import ChainMatch, same_chain
from .frames import JudgedChain, NotAChain
from .freedoms import SAME_FRAMES, SAME_MODEL, SAME_SENSES, Freedom, Used
from .parting import Parting

__all__ = [
    "SAME_FRAMES",
    "SAME_MODEL",
    "SAME_SENSES",
    "ChainMatch",
    "Freedom",
    "JudgedChain",
    "NotAChain",
    "Parting",
    "Used",
    "same_chain",
]
