// SPDX-License-Identifier: BSD-3-Clause
// A run's map, drawn by Leaflet: metres are its coordinates, (y, x).
'use strict';

/** name, colour, key; the colours are those of page.css. */
const kLayers = [
  ['lines', 'line'], ['seen floor', 'floor'], ['true world', 'world'], ['scan', 'scan'], ['frontier', 'frontier'],
  ['goal and way', 'way'], ['believed path', 'path'], ['true path', 'truth'], ['robot', 'robot'],
  ['rooms', 'room'],
];
/** What is hidden until somebody asks for it: the walls come first. */
const kHiddenAtFirst = ['believed path', 'true path'];

function colour(name) { return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim(); }

function clockOf(s) { return Math.floor(s / 60) + ':' + String(Math.floor(s % 60)).padStart(2, '0'); }

const toPlace = ([x, y]) => [y, x];

/** [from, to] m, without what a pose that has gone astray saw. */
function whereMostAre(values) {
  const sorted = Float64Array.from(values).sort(), at = (share) => sorted[Math.floor(share * (sorted.length - 1))];
  const margin = Math.max(100, 0.2 * (at(0.95) - at(0.05)));
  return [at(0.05) - margin, at(0.95) + margin];
}

/** The obstacles of a world as a picture. */
function worldPicture(world) {
  const canvas = document.createElement('canvas');
  canvas.width = world.width;
  canvas.height = world.height;
  const context = canvas.getContext('2d');
  context.fillStyle = colour('world');
  let at = 0, isObstacle = false;
  for (const run of world.runs) {
    for (let cell = at; isObstacle && cell < at + run;) {
      const row = Math.floor(cell / world.width), column = cell % world.width;
      const length = Math.min(at + run - cell, world.width - column);
      context.fillRect(column, world.height - 1 - row, length, 1);
      cell += length;
    }
    at += run;
    isObstacle = !isObstacle;
  }
  return canvas.toDataURL();
}

/** Where the laser has looked through up to a moment: a picture that scan after scan is added to. */
class SeenFloor {
  constructor(run, bounds) {
    const size = [bounds.getEast() - bounds.getWest(), bounds.getNorth() - bounds.getSouth()];
    this.run = run;
    this.pixel = Math.max(0.05, Math.max(...size) / 1200);  // m
    this.west = bounds.getWest();
    this.north = bounds.getNorth();
    this.canvas = document.createElement('canvas');
    [this.canvas.width, this.canvas.height] = size.map((length) => Math.max(1, Math.ceil(length / this.pixel)));
    this.context = this.canvas.getContext('2d');
    this.moment = -1;
    this.kept = new Map();  // what the picture was, at a few moments, for who goes back
    this.every = Math.max(1, Math.ceil(run.size / 12));
  }

  show(moment) {
    if (moment < this.moment) this.goBack(moment);
    while (this.moment < moment) {
      this.add(++this.moment);
      if (this.moment % this.every === 0 && !this.kept.has(this.moment)) this.keep();
    }
  }

  /** Gives all of it another colour. */
  paint() {
    this.kept.clear();
    this.moment = -1;
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.context.fillStyle = colour('floor');
  }

  add(moment) {
    this.context.beginPath();
    for (const [x, y] of this.run.scanAt(moment)) {
      this.context.lineTo((x - this.west) / this.pixel, (this.north - y) / this.pixel);
    }
    this.context.fill();
  }

  keep() {
    const copy = Object.assign(document.createElement('canvas'), { width: this.canvas.width, height: this.canvas.height });
    copy.getContext('2d').drawImage(this.canvas, 0, 0);
    this.kept.set(this.moment, copy);
  }

  goBack(moment) {
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.moment = Math.max(-1, ...Array.from(this.kept.keys()).filter((kept) => kept <= moment));
    if (this.moment >= 0) this.context.drawImage(this.kept.get(this.moment), 0, 0);
  }
}

class RunMap {
  constructor(run, element) {
    this.run = run;
    this.map = L.map(element, { crs: L.CRS.Simple, attributionControl: false, zoomSnap: 0, zoomDelta: 0.5,
                                minZoom: -4, maxZoom: 12, wheelPxPerZoomLevel: 120, fadeAnimation: false,
                                keyboard: false, zoomAnimation: !matchMedia('(prefers-reduced-motion: reduce)').matches });
    // Who comes here by the keyboard moves the map by it; after a click, keys are the player's.
    element.tabIndex = 0;
    element.setAttribute('aria-label', `Map of ${run.title}: arrows move it, + and - zoom`);
    element.addEventListener('focus', () => { this.takesKeys = element.matches(':focus-visible'); });
    element.addEventListener('blur', () => { this.takesKeys = false; });
    element.addEventListener('mousedown', () => { this.takesKeys = false; });
    L.control.scale({ imperial: false }).addTo(this.map);
    // Lines alone feel the mouse; what moves lies in canvases of its own, so that they are not drawn anew for it.
    const canvas = (pane, level, feels) => {
      const style = this.map.createPane(pane).style;
      style.zIndex = level;
      if (!feels) style.pointerEvents = 'none';
      return L.canvas({ pane, tolerance: feels ? 6 : 0 });
    };
    const below = { renderer: canvas('below', 300), interactive: false };
    const above = { renderer: canvas('above', 500), interactive: false };
    this.map.createPane('floor').style.zIndex = 150;
    this.map.createPane('world').style.zIndex = 200;
    this.lineRenderer = canvas('lines', 400, true);
    this.layers = {};
    for (const [name] of kLayers) this.layers[name] = L.layerGroup().addTo(this.map);
    const put = (name, layer) => { this.layers[name].addLayer(layer); return layer; };
    this.frontier = put('frontier', L.polygon([], { ...below, stroke: false, fillOpacity: 0.6 }));
    this.scan = put('scan', L.polygon([], { ...below, weight: 1, fillOpacity: 0.12 }));
    this.path = put('believed path', L.polyline([], { ...below, weight: 1.5, smoothFactor: 1 }));
    this.truth = put('true path', L.polyline([], { ...below, weight: 1.5, dashArray: '4 4' }));
    this.way = put('goal and way', L.polyline([], { ...above, weight: 2, dashArray: '6 5' }));
    this.goal = put('goal and way', L.circleMarker([0, 0], { ...above, radius: 6, weight: 3, fillOpacity: 0.2 }));
    this.robot = put('robot', L.polygon([], { ...above, weight: 2, fillOpacity: 0.6 }));
    this.drawn = new Map();  // id: polyline
    this.chosen = new Set();  // ids
    this.now = new Map();    // id: index of the change that it was last drawn by
    this.stale = new Set();
    this.lineChanges = new Changes(run.lines.frame, (i) => {
      const id = run.lines.id[i];
      this.now.set(id, i);
      this.stale.add(id);
    }, () => {
      for (const id of this.now.keys()) this.stale.add(id);
      this.now.clear();
    });
    this.blocks = new Map();
    this.frontierChanges = new Changes(run.frontier.frame, (i) => {
      const { x, y } = run.frontier, key = x[i] + ',' + y[i];
      if (!this.blocks.delete(key)) this.blocks.set(key, [x[i] * run.block, y[i] * run.block]);
    }, () => this.blocks.clear());
    this.moment = -1;
    this.tracePaths();
    this.rooms = run.rooms.map((room) => this.makeRoom(room));
    this.bounds = this.findBounds();
    this.layFloor(0.1);
    this.paint();
    this.showAll();
  }

  tracePaths() {
    const { pose, truth } = this.run;
    this.wholePath = Array.from(pose.x, (x, i) => [pose.y[i], x]);
    this.wholeTruth = truth && Array.from(truth.x, (x, i) => [truth.y[i], x]);
  }

  /** A floor for all that lies within the bounds. @param share  of them, that is left around. */
  layFloor(share) {
    this.floorBounds = this.bounds.pad(share);
    this.floor = new SeenFloor(this.run, this.floorBounds);
    this.layers['seen floor'].clearLayers();
    L.svgOverlay(this.floor.canvas, this.floorBounds, { pane: 'floor', className: 'floor', interactive: false })
      .addTo(this.layers['seen floor']);
  }

  /** Takes what has come of a run that goes on; show() shows it. */
  append(data) {
    this.run.append(data);
    if (data.frames.time.length + data.lines.frame.length === 0) return;
    this.tracePaths();
    this.moment = -1;  // lines may have changed at the last moment, too
    const grown = this.findBounds(), wasWhole = this.isWhole;
    const grew = !this.bounds.contains(grown);
    this.bounds = grown;
    if (!this.floorBounds.contains(grown)) {
      this.layFloor(0.5);  // by half: so it is laid anew a few times only, however large the place
      this.floor.paint();
    }
    if (grew && wasWhole) this.showAll();
  }

  findBounds() {
    const { pose, lines: { x1, y1, x2, y2 } } = this.run;
    const [left, right] = whereMostAre(pose.x), [low, high] = whereMostAre(pose.y);
    const bounds = L.latLngBounds([]);
    const extend = (x, y) => { if (x >= left && x <= right && y >= low && y <= high) bounds.extend([y, x]); };
    for (let i = 0; i < x1.length; ++i) {
      extend(x1[i], y1[i]);
      extend(x2[i], y2[i]);
    }
    for (let i = 0; i < pose.x.length; ++i) extend(pose.x[i], pose.y[i]);
    if (this.run.world) bounds.extend(this.worldBounds());
    return bounds;
  }

  worldBounds() {
    const { x, y, width, height, resolution } = this.run.world;
    return L.latLngBounds([y, x], [y + height * resolution, x + width * resolution]);
  }

  showAll() {
    this.map.fitBounds(this.bounds, { animate: false, padding: [10, 10] });
    this.wholeView = String([this.map.getCenter(), this.map.getZoom()]);
  }

  /** Whether nobody has moved the map since it was shown as a whole. */
  get isWhole() { return this.wholeView === String([this.map.getCenter(), this.map.getZoom()]); }

  /** Gives all its colour: at first, and where the page turns dark or light. */
  paint() {
    const fill = (name) => ({ color: colour(name), fillColor: colour(name) });
    this.frontier.setStyle(fill('frontier'));
    this.scan.setStyle(fill('scan'));
    this.path.setStyle(fill('path'));
    this.truth.setStyle(fill('truth'));
    this.way.setStyle(fill('way'));
    this.goal.setStyle(fill('way'));
    this.robot.setStyle(fill('robot'));
    for (const room of this.rooms) room.setStyle(fill('room'));
    this.paintLines();
    this.floor.paint();
    if (this.moment >= 0) this.floor.show(this.moment);
    if (!this.run.world) return;
    this.layers['true world'].clearLayers();
    L.imageOverlay(worldPicture(this.run.world), this.worldBounds(), { pane: 'world', className: 'world', alt: 'true world' })
      .addTo(this.layers['true world']);
  }

  styleOf(id) {
    return this.chosen.has(id) ? { color: colour('robot'), weight: 5 } : { color: colour('line'), weight: 2.5 };
  }

  paintLines() { for (const [id, line] of this.drawn) line.setStyle(this.styleOf(id)); }

  /** The end of a line that is meant by a place so near it; else the place. */
  snapped(place) {
    if (!this.map.hasLayer(this.layers.lines)) return place;
    const at = this.map.latLngToContainerPoint(place);
    let nearest = kSnap, best = place;
    for (const line of this.drawn.values()) {
      for (const end of line.getLatLngs()) {
        const distance = at.distanceTo(this.map.latLngToContainerPoint(end));
        if (distance < nearest) [nearest, best] = [distance, end];
      }
    }
    return best;
  }

  setVisible(name, isVisible) {
    if (isVisible) this.map.addLayer(this.layers[name]); else this.map.removeLayer(this.layers[name]);
  }

  /** Shows a time [s since the first moment]. @return the decision that stood then. */
  show(time) {
    const run = this.run, moment = run.momentAt(time), pose = run.poseAt(time);
    this.drawRobot(pose);
    const decision = run.decisionAt(moment);
    if (moment === this.moment) return decision;
    this.scan.setLatLngs(run.scanAt(moment).map(toPlace));
    this.floor.show(moment);
    this.path.setLatLngs(this.wholePath.slice(0, moment + 1));
    if (this.wholeTruth) this.truth.setLatLngs(this.wholeTruth.slice(0, moment + 1));
    this.drawDecision(decision);
    if (this.frontierChanges.goTo(moment)) this.drawFrontier();
    if (this.lineChanges.goTo(moment)) this.drawLines();
    this.drawRooms(moment === run.size - 1);
    this.moment = moment;
    return decision;
  }

  /** A room, lightly: lines are seen through it, and feel the mouse before it does. */
  makeRoom({ id, name, area, rings }) {
    const ring = (numbers) => Array.from({ length: numbers.length / 2 }, (_, i) => [1e-3 * numbers[2 * i + 1], 1e-3 * numbers[2 * i]]);
    const room = L.polygon(rings.map(ring), { renderer: this.lineRenderer, weight: 1, opacity: 0.5, fillOpacity: 0.1, bubblingMouseEvents: true });
    const told = document.createElement('span');
    told.textContent = `${name || 'room ' + id}, ${area.toFixed(1)} m²`;
    room.bindTooltip(told, { sticky: true });
    room.on('add', () => room.bringToBack());
    return room.on('mouseover', () => room.setStyle({ fillOpacity: 0.25 })).on('mouseout', () => room.setStyle({ fillOpacity: 0.1 }));
  }

  /** Rooms are those of the finished map: earlier there are none. */
  drawRooms(areThere) {
    for (const room of this.rooms) {
      if (!areThere) this.layers.rooms.removeLayer(room);
      else if (!this.layers.rooms.hasLayer(room)) this.layers.rooms.addLayer(room);
    }
  }

  drawRobot({ x, y, theta }) {
    const radius = this.run.robotRadius, outline = [];
    for (let k = -5; k <= 5; ++k) {  // round at the back, pointed at the front
      outline.push([y + radius * Math.sin(theta + Math.PI + k * 0.21), x + radius * Math.cos(theta + Math.PI + k * 0.21)]);
    }
    outline.push([y + 1.6 * radius * Math.sin(theta), x + 1.6 * radius * Math.cos(theta)]);
    this.robot.setLatLngs(outline);
  }

  drawDecision({ goal, way }) {
    const places = [];
    for (let i = 0; i + 1 < way.length; i += 2) places.push([1e-3 * way[i + 1], 1e-3 * way[i]]);
    this.way.setLatLngs(places);
    this.goal.setStyle({ stroke: !!goal, fill: !!goal });
    if (goal) this.goal.setLatLng([1e-3 * goal[1], 1e-3 * goal[0]]);
  }

  drawFrontier() {
    const b = this.run.block;
    this.frontier.setLatLngs(Array.from(this.blocks.values(), ([x, y]) => [[[y, x], [y, x + b], [y + b, x + b], [y + b, x]]]));
  }

  drawLines() {
    const { support, x1, y1, x2, y2 } = this.run.lines;
    for (const id of this.stale) {
      const i = this.now.get(id), isThere = i !== undefined && support[i] > 0, line = this.drawn.get(id);
      if (!isThere && line) {
        this.layers.lines.removeLayer(line);
        this.drawn.delete(id);
      } else if (isThere && line) {
        line.setLatLngs([[y1[i], x1[i]], [y2[i], x2[i]]]);
      } else if (isThere) {
        const fresh = L.polyline([[y1[i], x1[i]], [y2[i], x2[i]]],
                                 { renderer: this.lineRenderer, ...this.styleOf(id), bubblingMouseEvents: true });
        fresh.on('click', () => { this.hit = id; });  // before the map hears of the click
        fresh.bindTooltip(() => this.facts(id).join('<br>'), { sticky: true });
        fresh.on('mouseover', () => fresh.setStyle({ weight: 5 })).on('mouseout', () => fresh.setStyle(this.styleOf(id)));
        this.drawn.set(id, fresh);
        this.layers.lines.addLayer(fresh);
      }
    }
    this.stale.clear();
  }

  lengthOf(id) {
    const { x1, y1, x2, y2 } = this.run.lines, i = this.now.get(id);
    return Math.hypot(x2[i] - x1[i], y2[i] - y1[i]);
  }

  /** What is told of a line under the mouse, and of one that was chosen. */
  facts(id) {
    const l = this.run.lines, i = this.now.get(id), [ox, oy] = this.run.origin;
    if (i === undefined) return [];
    const at = (change) => clockOf(this.run.time[l.frame[change]] - this.run.begin);
    const end = (x, y) => (ox + x).toFixed(3) + ', ' + (oy + y).toFixed(3);
    return [`line ${id}`, `length ${this.lengthOf(id).toFixed(3)} m`,
            `support ${l.support[i]} returns`,
            `sigma ${(1e3 * l.sigmaOffset[i]).toFixed(2)} mm, ${(l.sigmaAngle[i] * 180 / Math.PI).toFixed(3)} deg`,
            `from ${end(l.x1[i], l.y1[i])}`, `to ${end(l.x2[i], l.y2[i])} m`,
            `seen since ${at(l.id.indexOf(id))}, as it is since ${at(i)}`];
  }
}
