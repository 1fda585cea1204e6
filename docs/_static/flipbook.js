// Sliders over pictures that were drawn beforehand (dhkit.flipbook): one value moves at a time, the others go back to where
// they began.

for (const place of document.querySelectorAll(".dhkit-flipbook")) {
  const image = place.querySelector("img"), still = image.src;
  const rows = JSON.parse(place.querySelector("script").textContent).map(({ name, stops, start, pages }) => {
    const slider = Object.assign(document.createElement("input"), { type: "range", min: 0, max: stops.length - 1, value: start });
    const row = document.createElement("label"), output = document.createElement("output");
    const set = (k) => {
      slider.value = k;
      output.textContent = String(stops[k]).replace("-", "\u2212");
      slider.setAttribute("aria-valuetext", output.textContent);
    };
    slider.addEventListener("input", () => {
      const k = Number(slider.value);
      for (const other of rows) other.reset();
      set(k);
      image.src = pages[k] || still;
    });
    row.append(name, slider, output);
    set(start);
    return { row, reset: () => set(start) };
  });
  place.prepend(...rows.map(({ row }) => row));
}
