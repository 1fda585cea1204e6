"""A live robot from its table: turn it, move its joints, compare its postures, watch it follow a path.

``Scene(table, values)`` at the end of a cell shows it; ``scene.q = [...]`` moves it, ``scene.ghosts(solutions)`` sets
all postures beside it, ``scene.play(path)`` moves it along a path, ``scene.save("arm.html")`` writes a page that needs
neither Python nor a network. ``ParallelScene(base, platform, pose)`` does the same for a platform on three legs.

The picture is drawn by the reader's browser (``scene.js``, built from ``js/`` by ``make scene``). Where no widget runs, or
nobody sits before the notebook (nbconvert, the grader), the still drawing stands in its place.
"""

from .parallel import ParallelScene
from .scene import Scene

__all__ = ["ParallelScene", "Scene"]
