// The clock of the tosses that are played: play, pause, the time's slider, and the speed.

const still = matchMedia("(prefers-reduced-motion: reduce)");

export function makePlayer(onTime) {
  const [button, slider, clock, speed] = ["play", "time", "clock", "speed"].map((id) => document.getElementById(id));
  let end = 0, time = 0, last = null, playing = false;

  function tick(now) {
    if (!playing) return;
    time = Math.min(time + (Math.max(now - (last ?? now), 0) / 1000) * Number(speed.value), end);
    last = now;
    if (time >= end) stop();
    told();
    if (playing) requestAnimationFrame(tick);
  }

  function told() {
    slider.value = String(time);
    clock.textContent = `${time.toFixed(3)} s`;
    slider.setAttribute("aria-valuetext", clock.textContent);
    button.textContent = playing ? "Pause" : "Play";
    onTime(time);
  }

  function stop() {
    playing = false;
    last = null;
  }

  function play() {
    if (time >= end) time = 0;
    playing = true;
    last = null;
    requestAnimationFrame(tick);
  }

  button.addEventListener("click", () => {
    playing ? stop() : play();
    told();
  });
  slider.addEventListener("input", () => seek(Number(slider.value)));

  function seek(wanted) {
    stop();
    time = Math.min(Math.max(wanted, 0), end);
    told();
  }

  return {
    // Other tosses, up to `until`; from the start where they are of another pixel.
    load(until, fresh) {
      end = until;
      slider.max = String(end);
      slider.disabled = button.disabled = end === 0;
      if (fresh) {
        time = still.matches ? end : 0;
        if (!still.matches && end > 0) play();
      }
      told();
    },
    seek,
    redraw: () => onTime(time),
  };
}
