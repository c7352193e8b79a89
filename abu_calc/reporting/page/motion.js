const canvas = document.getElementById("motion"), pen = canvas.getContext("2d");
const play = document.getElementById("motion-play"), time = document.getElementById("motion-time");
const pace = document.getElementById("motion-pace"), told = document.getElementById("motion-told");
const start = document.getElementById("motion-start"), side = 320, turn = Math.PI / 180;
let run, last, reach, now = 0, playing = false, before = 0, printing = false, kept = 0;

function choose(one) {
  run = one;
  last = run.t[run.t.length - 1];
  reach = 1.15 * Math.max(1e-9, ...run.x.map((x, k) => Math.hypot(x, run.y[k])));
  time.max = last;
  keepPlaying(false);
  set(0);
}

function colour(name) {
  const paper = { ink: "#000", soft: "#444", line: "#bbb", c1: "#0072b2", c2: "#b84a00", fail: "#a40e26" };
  return printing ? paper[name] : getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}
function sample() {
  let k = 0;
  while (k < run.t.length - 1 && run.t[k + 1] <= now) k++;
  return k;
}
function circle(x, y, radius, fill, stroke) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  if (stroke) { pen.strokeStyle = stroke; pen.stroke(); }
}
function write(words, x, y, name) {
  pen.fillStyle = colour(name);
  pen.font = "15px system-ui, Arial, sans-serif";
  pen.textAlign = "center";
  pen.fillText(words, x, y);
}
function draw() {
  const k = sample(), middle = side / 2 + 12, scale = 118 / data.race;
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.lineWidth = 2;
  write("balls in the race", side / 2, 16, "soft");
  circle(side / 2, middle, 118, null, colour("ink"));
  const angle = run.imbalance * turn, far = 0.42 * 118;
  pen.strokeStyle = colour("fail");
  pen.beginPath();
  pen.moveTo(side / 2, middle);
  pen.lineTo(side / 2 + far * Math.cos(angle), middle - far * Math.sin(angle));
  pen.stroke();
  circle(side / 2 + far * Math.cos(angle), middle - far * Math.sin(angle), 5, colour("fail"));
  run.balls.forEach((row, ball) => {
    const at = row[k] * turn, pitch = data.pitch[ball] * scale;
    circle(side / 2 + pitch * Math.cos(at), middle - pitch * Math.sin(at), data.ball[ball] * scale, colour("c1"), colour("ink"));
  });
  write("axis, circle " + Number(reach.toPrecision(2)) + " µm", 1.5 * side, 16, "soft");
  circle(1.5 * side, middle, 118, null, colour("line"));
  circle(1.5 * side, middle, 2, colour("soft"));
  const at = (index) => [1.5 * side + (118 / reach) * run.x[index], middle - (118 / reach) * run.y[index]];
  pen.strokeStyle = colour("c2");
  pen.lineWidth = 1.2;
  pen.beginPath();
  for (let index = 0; index <= k; index++) pen.lineTo(...at(index));
  pen.stroke();
  circle(...at(k), 5, colour("c2"));
  told.textContent = now.toFixed(3) + " s, " + Number(run.rest[k].toPrecision(3)) + " g·mm left";
  time.value = now;
  time.setAttribute("aria-valuetext", told.textContent);
}
function set(value) {
  now = Math.min(last, Math.max(0, value));
  draw();
}
function keepPlaying(wanted) {
  playing = wanted;
  play.textContent = playing ? "Pause" : "Play";
  if (!playing) return;
  if (now >= last) now = 0;
  before = performance.now();
  requestAnimationFrame(step);
}
function step(instant) {
  if (!playing) return;
  set(now + (Math.max(0, instant - before) / 1000) * Number(pace.value));
  before = instant;
  if (now >= last) keepPlaying(false);
  else requestAnimationFrame(step);
}
play.addEventListener("click", () => keepPlaying(!playing));
time.addEventListener("input", () => { keepPlaying(false); set(Number(time.value)); });
if (start) start.addEventListener("change", () => choose(data.runs[Number(start.value)]));
canvas.addEventListener("keydown", (event) => {
  const moves = { ArrowLeft: now - last / 50, ArrowRight: now + last / 50, Home: 0, End: last };
  if (event.key === " ") keepPlaying(!playing);
  else if (event.key in moves) { keepPlaying(false); set(moves[event.key]); }
  else return;
  event.preventDefault();
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
addEventListener("beforeprint", () => { keepPlaying(false); printing = true; kept = now; set(last); });
addEventListener("afterprint", () => { printing = false; set(kept); });
choose(data.runs[0]);
