"""Two modified DH tables compared as chains of joint axes."""

from .alignment import Freedom
from .compare import SAME_MODEL, ChainMatch, Parting, Used, same_chain
from .frames import JudgedChain, NotAChain, transforms

__all__ = [
    "SAME_MODEL",
    "ChainMatch",
    "Freedom",
    "JudgedChain",
    "NotAChain",
    "Parting",
    "Used",
    "same_chain",
    "transforms",
]
