// SPDX-License-Identifier: BSD-3-Clause
// The page: its runs side by side, the time they are shown at, and what the user does.
'use strict';

const byId = (id) => document.getElementById(id);

class Player {
  constructor() {
    this.maps = [];
    this.charts = [];
    this.time = 0;
    this.last = null;  // ms, when the last picture was drawn while playing; null: paused
    this.hidden = new Set(kHiddenAtFirst);
    this.measureFrom = null;
    this.selection = new Selection(this);
    this.connect();
  }

  get duration() { return Math.max(...this.maps.map(({ run }) => run.duration)); }
  get isPlaying() { return this.last !== null; }

  addRun(run) {
    const section = document.createElement('section');
    section.className = 'panel';
    const title = document.createElement('h2'), map = document.createElement('div'), reason = document.createElement('p');
    title.append(run.title + ' ');
    title.append(Object.assign(document.createElement('small'), { className: 'numbers' }));
    map.className = 'map';
    reason.className = 'reason';
    section.append(title, map, reason);
    byId('runs').append(section);
    const view = new RunMap(run, map);
    Object.assign(view, { reason, numbers: title.querySelector('.numbers') });
    this.maps.push(view);
    new ResizeObserver(() => view.map.invalidateSize({ animate: false })).observe(map);
    view.map.on('move', () => this.follow(view)).on('moveend', () => this.writeAddress())
      .on('click', (event) => this.live?.send(event.latlng) || this.click(view, event))
      .on('mousemove', (event) => this.drawMeasure(view, view.snapped(event.latlng)));
    for (const name of this.hidden) view.setVisible(name, false);
    byId('timeline').max = this.duration;
    this.makeCharts();
    this.makeLayerBoxes();
    this.showWhole();
    this.show(this.time);
  }

  removeLastRun() {
    const old = this.maps.pop();
    old.map.getContainer().parentElement.remove();
    old.map.remove();
  }

  /** The charts of runs that have grown. */
  updateCharts() {
    const curves = curvesOf(this.maps.map(({ run }) => run));
    if (curves.length !== this.charts.length) return this.makeCharts();
    this.charts.forEach((chart, i) => chart.update(curves[i][1]));
  }

  /** Other maps show what this one does. */
  follow(view) {
    if (this.follows) return;
    this.follows = true;
    for (const other of this.maps) {
      if (other !== view) other.map.setView(view.map.getCenter(), view.map.getZoom(), { animate: false });
    }
    this.follows = false;
  }

  showWhole() {
    for (const view of this.maps) view.map.invalidateSize({ animate: false });
    this.maps[0].showAll();
  }

  makeCharts() {
    byId('charts').replaceChildren();
    this.charts = curvesOf(this.maps.map(({ run }) => run)).map(([title, curves]) => {
      const element = byId('charts').appendChild(document.createElement('div'));
      return new Chart(element, title, curves, (distance) => this.seekDistance(distance));
    });
  }

  makeLayerBoxes() {
    const isThere = ({ run }, name) => {
      if (name === 'true world') return !!run.world;
      if (name === 'rooms') return run.rooms.length > 0;
      if (name === 'true path') return !!run.truth;
      if (name === 'frontier') return run.frontier.x.length > 0;
      return name !== 'goal and way' || run.decisions.some((d) => d.goal || d.way.length);
    };
    byId('layers').replaceChildren(...kLayers.filter(([name]) => this.maps.some((view) => isThere(view, name)))
      .map(([name, colourName], i) => {
        const label = document.createElement('label'), box = document.createElement('input');
        const swatch = Object.assign(document.createElement('span'), { className: 'swatch' });
        swatch.style.background = `var(--${colourName})`;
        Object.assign(box, { type: 'checkbox', checked: !this.hidden.has(name), name });
        label.title = `Show or hide (${i + 1})`;
        box.addEventListener('change', () => {
          if (box.checked) this.hidden.delete(name); else this.hidden.add(name);
          for (const view of this.maps) view.setVisible(name, box.checked);
          this.writeAddress();
        });
        label.append(box, swatch, name);
        return label;
      }));
  }

  /** Shows a time, s since the beginning. */
  show(time) {
    this.time = Math.min(Math.max(0, time), this.duration);
    const distances = [];
    for (const view of this.maps) {
      const decision = view.show(this.time), { distance } = view.run.poseAt(this.time);
      distances.push(distance);
      view.reason.textContent = decision.reason;
      view.numbers.textContent = `${distance.toFixed(1)} m, ${view.drawn.size} lines`;
    }
    for (const chart of this.charts) chart.show(distances);
    byId('timeline').value = this.time;
    byId('clock').textContent = clockOf(this.time) + ' / ' + clockOf(this.duration);
    byId('timeline').setAttribute('aria-valuetext', byId('clock').textContent);
    this.writeAddress();
  }

  /** Keeps time, layers and view behind the '#' of the address, some time after the last change. */
  writeAddress() {
    if (!this.isOpen) return;  // nor does a run that goes on
    clearTimeout(this.writing);
    this.writing = setTimeout(() => {
      const { map } = this.maps[0], { lat, lng } = map.getCenter();
      const shown = kLayers.flatMap(([name]) => (this.hidden.has(name) ? [] : [name.replaceAll(' ', '-')]));
      const view = [lng.toFixed(2), lat.toFixed(2), map.getZoom().toFixed(2)];
      this.written = `#t=${+this.time.toFixed(2)}&layers=${shown}&view=${view}`;
      location.replace(this.written);  // no entry in the history, and allowed for files
    }, 300);
  }

  /** Shows what the address asks for; what it does not name stays. */
  readAddress() {
    const asked = new URLSearchParams(location.hash.slice(1)), numbers = (text) => text.split(',').map(Number);
    const layers = asked.get('layers'), view = numbers(asked.get('view') ?? ''), time = parseFloat(asked.get('t'));
    if (layers !== null) {
      const shown = layers.split(',').map((name) => name.replaceAll('-', ' '));
      this.hidden = new Set(kLayers.map(([name]) => name).filter((name) => !shown.includes(name)));
      for (const [name] of kLayers) for (const map of this.maps) map.setVisible(name, !this.hidden.has(name));
      this.makeLayerBoxes();
    }
    if (view.length === 3 && view.every(Number.isFinite)) {
      this.maps[0].map.setView([view[1], view[0]], view[2], { animate: false });
    }
    if (Number.isFinite(time)) this.show(time);
  }

  /** Shows a time that the user chose: where the run goes on, it is followed no more. */
  seek(time) {
    if (!this.maps.length) return;
    this.live?.follow(false);
    this.show(time);
  }

  seekDistance(distance) {
    const { run } = this.maps[0];
    this.seek(run.time[Math.max(0, lastUpTo(run.distance, distance))] - run.begin);
  }

  play(on) {
    if (on === this.isPlaying || !this.maps.length) return;
    if (on) this.live?.follow(false);
    byId('play').innerHTML = on ? '&#10074;&#10074;' : '&#9654;';
    byId('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
    if (!on) {
      this.last = null;
      return;
    }
    if (this.time >= this.duration) this.time = 0;
    this.last = performance.now();
    const draw = (now) => {
      if (!this.isPlaying) return;
      const next = this.time + Math.max(0, now - this.last) * 1e-3 * Number(byId('speed').value);
      this.last = now;
      this.show(next);
      if (this.time >= this.duration) this.play(false); else requestAnimationFrame(draw);
    };
    requestAnimationFrame(draw);
  }

  changeSpeed(step) {
    const speed = byId('speed');
    speed.selectedIndex = Math.min(Math.max(0, speed.selectedIndex + step), speed.options.length - 1);
  }

  setMeasuring(on) {
    byId('measure').setAttribute('aria-pressed', on);
    document.body.classList.toggle('measuring', on);
    byId('measured').textContent = on ? 'click where to measure from' : '';
    if (this.ruler) this.ruler.remove();
    this.ruler = this.measureFrom = null;
  }

  get isMeasuring() { return byId('measure').getAttribute('aria-pressed') === 'true'; }

  click(view, { latlng, originalEvent }) {
    if (this.isMeasuring) this.measure(view, view.snapped(latlng));
    else this.selection.select(view, view.hit, originalEvent.shiftKey);
    view.hit = undefined;
  }

  measure(view, place) {
    if (this.measureFrom) {
      this.drawMeasure(view, place);
      this.measureFrom = null;
      return;
    }
    if (this.ruler) this.ruler.remove();
    this.measureFrom = { view, place };
    this.ruler = L.polyline([place, place], { renderer: view.robot.options.renderer, interactive: false, color: colour('ink'), weight: 2 })
      .addTo(view.map);
  }

  drawMeasure(view, place) {
    if (!this.measureFrom || this.measureFrom.view !== view) return;
    const from = this.measureFrom.place, dx = place.lng - from.lng, dy = place.lat - from.lat;
    this.ruler.setLatLngs([from, place]);
    byId('measured').textContent = `${Math.hypot(dx, dy).toFixed(3)} m, ${(Math.atan2(dy, dx) * 180 / Math.PI).toFixed(1)} deg, `
                                   + `${Math.abs(dx).toFixed(3)} m by ${Math.abs(dy).toFixed(3)} m`;
  }

  async compare(file) {
    const page = new DOMParser().parseFromString(await file.text(), 'text/html');
    const data = page.querySelector('script.run');
    if (!data) return alert(file.name + ': holds no run');
    while (this.maps.length > 1) this.removeLastRun();
    this.addRun(await Run.read(data.textContent));
  }

  connect() {
    byId('play').addEventListener('click', () => this.play(!this.isPlaying));
    byId('timeline').addEventListener('input', (event) => this.seek(Number(event.target.value)));
    byId('measure').addEventListener('click', () => this.setMeasuring(!this.isMeasuring));
    byId('whole').addEventListener('click', () => this.showWhole());
    byId('compare').addEventListener('change', (event) => event.target.files[0] && this.compare(event.target.files[0]));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      if (!this.maps.length) return;
      for (const view of this.maps) view.paint();
      this.makeCharts();
      this.show(this.time);
    });
    document.addEventListener('keydown', (event) => this.press(event));
    addEventListener('hashchange', () => location.hash !== this.written && this.readAddress());
  }

  /** @return whether it is a key for the map. */
  moveMap(map, key) {
    const step = 60;  // pixels
    const way = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[key];
    if (way) map.panBy(way, { animate: false });
    else if (key === '+') map.zoomIn();
    else if (key === '-') map.zoomOut();
    else return false;
    return true;
  }

  press(event) {
    const { target, key } = event;
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const onMap = this.maps.find((view) => view.takesKeys && view.map.getContainer() === target);
    if (onMap && this.moveMap(onMap.map, key)) return event.preventDefault();
    if (target.closest('input[type=number]')) return;  // a number is being written
    const isElsewhere = target.closest('a, select, button, input[type=checkbox], .button');
    const far = event.shiftKey ? 10 : 1;
    const keys = {
      ArrowLeft: () => this.seek(this.time - far), ArrowRight: () => this.seek(this.time + far),
      Home: () => this.seek(0), End: () => this.seek(this.duration),
      ' ': () => this.play(!this.isPlaying),
    };
    const anywhere = {
      '+': () => this.changeSpeed(1), '-': () => this.changeSpeed(-1), 0: () => this.maps.length && this.showWhole(),
      m: () => this.setMeasuring(!this.isMeasuring),
      Escape: () => { this.setMeasuring(false); this.maps.length && this.selection.select(this.maps[0]); this.live?.setSending(false); },
    };
    const layer = byId('layers').children[Number(key) - 1];
    const action = (!isElsewhere && keys[key]) || anywhere[key] || this.live?.actionOf(key) || (layer && (() => layer.firstChild.click()));
    if (!action) return;
    action();
    event.preventDefault();
  }
}

(async () => {
  const player = new Player();
  if (document.querySelector('script.live')) {
    player.live = new Live(player);
    window.player = player;
    return;
  }
  for (const data of document.querySelectorAll('script.run')) player.addRun(await Run.read(data.textContent));
  player.show(player.duration);
  player.readAddress();
  player.isOpen = true;
  document.title = player.maps.map(({ run }) => run.title).join(' and ') + ' - cca-mrpt replay';
  window.player = player;
})();
