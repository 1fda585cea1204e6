"""A chain as a closed loop: constant links with motions about or along z between them.

L_0 Z(v_1) L_1 Z(v_2) ... Z(v_n) L_n = T, where v_i is the variable of row i, an angle or a slide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .forward import Chain
from .geometry import modified_dh_of_cosines


@dataclass(frozen=True)
class Loop:
    """Links (n + 1 matrices 4x4) and, for each of the n motions between them, if it is a slide, and which joint's."""

    links: tuple[np.ndarray, ...]
    slides: tuple[bool, ...]
    joints: tuple[int, ...]

    @classmethod
    def of(cls, chain: Chain) -> Loop:
        """The loop of a chain whose row i is moved by joint i alone."""
        links = [chain.base]
        for row in range(chain.joints):
            slide, turn = (0.0, chain.fixed[row]) if chain.prismatic[row] else (chain.fixed[row], 0.0)
            twist = chain.cos_alpha[row], chain.sin_alpha[row]
            links[-1] = links[-1] @ modified_dh_of_cosines(chain.a[row], *twist, slide, np.cos(turn), np.sin(turn))
            links.append(np.eye(4))
        links[-1] = chain.tail(chain.joints - 1)
        return cls(tuple(links), tuple(map(bool, chain.prismatic[: chain.joints])), tuple(range(chain.joints)))

    @property
    def size(self) -> float:
        """The sum of the links' lengths without base and tool, metres; 1 where they have none."""
        return float(sum(np.linalg.norm(link[:3, 3]) for link in self.links[1:-1])) or 1.0

    def scaled(self, factor: float) -> Loop:
        """The same loop in another unit of length."""
        return Loop(tuple(in_unit(link, factor) for link in self.links), self.slides, self.joints)

    def held(self, index: int, value: float) -> Loop:
        """The loop with one of its joints held at a value, the others numbered anew."""
        before, after = self.links[index : index + 2]
        link = before @ motion(self.slides[index], np.array(value)) @ after
        links = (*self.links[:index], link, *self.links[index + 2 :])
        return Loop(links, self.slides[:index] + self.slides[index + 1 :], tuple(range(len(self.slides) - 1)))

    def reversed(self) -> Loop:
        """The loop walked from the tool to the base: its pose is the inverse one, its variables are negative."""
        return Loop(tuple(np.linalg.inv(link) for link in self.links[::-1]), self.slides[::-1], self.joints[::-1])


def in_unit(T: np.ndarray, factor: float) -> np.ndarray:
    """Transforms (..., 4, 4) with their lengths multiplied by a factor."""
    T = np.array(T)
    T[..., :3, 3] *= factor
    return T


def motion(slide: bool, value: np.ndarray) -> np.ndarray:
    """Transforms (..., 4, 4) about (slide: along) z."""
    Z = np.zeros((*np.shape(value), 4, 4))
    Z[..., 2, 2] = Z[..., 3, 3] = 1.0
    if slide:
        Z[..., 0, 0] = Z[..., 1, 1] = 1.0
        Z[..., 2, 3] = value
    else:
        Z[..., 0, 0] = Z[..., 1, 1] = np.cos(value)
        Z[..., 1, 0] = np.sin(value)
        Z[..., 0, 1] = -Z[..., 1, 0]
    return Z
