// Every robot of a page comes alive when it is first seen; until then, and on paper, its still drawing stands there.
// The program of `dhkit.scene` is that of a widget: here its data stand for the kernel, which answers nothing.

function enliven(place) {
  const state = JSON.parse(place.querySelector("script").textContent);
  if (state.arm) state.arm.asks = false;
  if (state.cloud !== undefined) state.cloud = Uint8Array.from(atob(state.cloud), (letter) => letter.charCodeAt(0));
  const stage = place.appendChild(document.createElement("div"));
  stage.className = "stage";
  place.classList.add("live");
  const set = (name, value) => { state[name] = value; };
  dhkitScene.default.render({ el: stage, model: { get: (name) => state[name], set, on() {}, off() {}, save_changes() {} } });
}

const seen = new IntersectionObserver(
  (entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      enliven(target);
    }
  },
  { rootMargin: "200px" },
);
for (const place of document.querySelectorAll(".dhkit-scene")) seen.observe(place);
