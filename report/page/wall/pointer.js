/** Drag turns, wheel and two fingers zoom, shift and drag shifts, double click goes back. */
export function followPointer(canvas, camera, redraw) {
  const held = new Map();
  let apart = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
    apart = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    held.set(event.pointerId, [event.clientX, event.clientY]);
    if (held.size === 2) {
      const [a, b] = [...held.values()],
        now = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (apart) camera.zoom = Math.max(0.3, Math.min(20, camera.zoom * (now / apart)));
      apart = now;
    } else if (event.shiftKey) {
      camera.shift[0] += (2 * dx) / canvas.clientWidth;
      camera.shift[1] -= (2 * dy) / canvas.clientHeight;
    } else {
      camera.yaw -= dx * 0.01;
      camera.pitch = Math.max(-1.5, Math.min(1.5, camera.pitch + dy * 0.01));
    }
    redraw();
  });
  const release = (event) => held.delete(event.pointerId);
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !event.shiftKey && document.activeElement !== canvas) return;
      event.preventDefault();
      camera.zoom = Math.max(0.3, Math.min(20, camera.zoom * Math.exp(-event.deltaY * 0.0015)));
      redraw();
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", () => {
    camera.reset();
    redraw();
  });
  canvas.addEventListener("keydown", (event) => {
    const by = {
      ArrowLeft: [-0.12, 0, 1],
      ArrowRight: [0.12, 0, 1],
      ArrowUp: [0, 0.12, 1],
      ArrowDown: [0, -0.12, 1],
      "+": [0, 0, 1.15],
      "-": [0, 0, 1 / 1.15],
    }[event.key];
    if (!by) return;
    event.preventDefault();
    camera.yaw += by[0];
    camera.pitch = Math.max(-1.5, Math.min(1.5, camera.pitch + by[1]));
    camera.zoom *= by[2];
    redraw();
  });
}
