// Labels over the picture, each beside what it names and clear of the others.

const TURNS = [0, 30, -30, 60, -60, 90, -90, 130, -130, 180].map((degrees) => (degrees * Math.PI) / 180);
const EXTRA = [0, 10, 22]; // further away than wished, in pixels

/** How deep two boxes {x, y, w, h}, of given centre and size, lie in one another: 0 if apart. */
function overlap(one, two) {
  const wide = (one.w + two.w) / 2 + 3 - Math.abs(one.x - two.x), high = (one.h + two.h) / 2 - Math.abs(one.y - two.y);
  return wide > 0 && high > 0 ? Math.min(wide, high) : 0;
}

/** Boxes that a label may take, the best first, with what each costs. */
function options({ x, y, heading, gap, w, h }) {
  return TURNS.flatMap((turn) => EXTRA.map((extra) => {
    const out = [Math.cos(heading + turn), Math.sin(heading + turn)];
    const reach = Math.min(w / 2 / Math.max(Math.abs(out[0]), 1e-9), h / 2 / Math.max(Math.abs(out[1]), 1e-9)) + gap + extra;
    return { x: x + reach * out[0], y: y + reach * out[1], w, h, cost: 2 * Math.abs(turn) + 0.12 * extra, key: `${turn} ${extra}` };
  }));
}

/**
 * Places for labels {x, y, heading, gap, w, h}, in the order of their importance: boxes, or null where there is no room.
 * `held` tells what each took before, which it keeps if it can: labels do not jump about. No label covers an obstacle.
 */
export function arrange(wanted, width, height, held = [], obstacles = []) {
  const taken = [...obstacles];
  return wanted.map((label, k) => {
    let best = null;
    for (const box of options(label)) {
      const out = Math.max(box.w / 2 - box.x, box.x + box.w / 2 - width, box.h / 2 - box.y, box.y + box.h / 2 - height, 0);
      if (out > 0 || taken.some((other) => overlap(box, other))) continue;
      const cost = box.cost - (box.key === held[k] ? 1.2 : 0);
      if (!best || cost < best.cost) best = { ...box, cost };
    }
    if (best) taken.push(best);
    return best;
  });
}

/** An index below the line. */
export function below(index) {
  const element = document.createElement("sub");
  element.textContent = index;
  return element;
}

/** The labels of one picture, as elements of `layer`. Their texts are text, never HTML. */
export class Labels {
  constructor(layer) {
    this.layer = layer;
    this.elements = new Map();
  }

  /** Show labels {id, text, kind, x, y, heading, gap}, the most important first; a text is a list of [name, index]. */
  show(labels, width, height, obstacles) {
    const ids = new Set(labels.map((label) => label.id));
    for (const [id, entry] of this.elements) {
      if (!ids.has(id)) {
        entry.element.remove();
        this.elements.delete(id);
      }
    }
    const entries = labels.map((label) => this.#entry(label));
    const wanted = labels.map((label, k) => ({ ...label, w: entries[k].w, h: entries[k].h }));
    const boxes = arrange(wanted, width, height, entries.map((entry) => entry.held), obstacles);
    entries.forEach((entry, k) => {
      const box = boxes[k];
      entry.element.style.visibility = box ? "visible" : "hidden";
      entry.held = box?.key;
      if (box) entry.element.style.transform = `translate(${box.x - box.w / 2}px, ${box.y - box.h / 2}px)`;
    });
  }

  #entry({ id, text, kind }) {
    let entry = this.elements.get(id);
    if (!entry) {
      const element = document.createElement("span");
      this.layer.append(element);
      this.elements.set(id, (entry = { element }));
    }
    const key = text.join("\n");
    if (entry.key !== key || !entry.w) {
      entry.key = key;
      entry.element.replaceChildren(...text.flatMap(([name, index], i) => [(i ? " " : "") + name, below(index)]));
      entry.element.className = `label ${kind}`;
      entry.w = entry.element.offsetWidth;
      entry.h = entry.element.offsetHeight;
    }
    return entry;
  }
}
