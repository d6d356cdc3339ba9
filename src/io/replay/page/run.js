// SPDX-License-Identifier: BSD-3-Clause
// A run, as Replay::packed() in C++ has put it, and what it was at each moment.
'use strict';

const kJump = 1.0;  // m, between two moments: a correction, not a drive

/** Appends the numbers of which a column holds the differences. @param unit  of one of them. */
function undo(numbers, column, unit = 1) {
  let sum = 0;
  for (const difference of column) numbers.push((sum += difference) * unit);
}

/** The text that was deflated and written in base64. */
async function unpack(base64) {
  const bytes = Uint8Array.from(atob(base64.trim().replace(/\s/g, '')), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).text();
}

/** The last i with sorted[i] <= value; -1 where there is none. */
function lastUpTo(sorted, value) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= value) low = middle + 1; else high = middle;
  }
  return low - 1;
}

class Run {
  /** @param goesOn  whether append() is to follow. */
  static async read(text, goesOn = false) {
    const [packed, rooms] = text.split('.');
    const run = new Run(JSON.parse(await unpack(packed)), goesOn);
    if (rooms) run.rooms = JSON.parse(await unpack(rooms));
    return run;
  }

  constructor(data, goesOn) {
    this.title = data.title;
    this.origin = data.origin;  // m, map frame
    this.robotRadius = data.robot_radius;
    this.block = data.frontier_block;
    this.world = data.world;
    this.rooms = [];  // of the finished map
    const columns = (...names) => Object.fromEntries(names.map((name) => [name, []]));
    Object.assign(this, columns('time', 'distance', 'laserOf', 'ranges', 'rangesBegin', 'decisions', 'decisionFrames'));
    this.pose = columns('x', 'y', 'theta');
    this.truth = data.frames.true_x && columns('x', 'y', 'theta');
    this.frontier = columns('frame', 'x', 'y');
    this.lines = columns('frame', 'id', 'x1', 'y1', 'x2', 'y2', 'support', 'sigmaOffset', 'sigmaAngle');
    this.coverage = columns('distance', 'share');
    this.append(data);
    if (!goesOn && this.truth && this.poseErrors().every((error) => error === 0)) this.truth = null;  // they are the same
  }

  /** Takes what comes after all that is here. */
  append(data) {
    const f = data.frames;
    undo(this.time, f.time, 1e-3);
    undo(this.distance, f.distance, 1e-3);
    for (const name of ['x', 'y', 'theta']) {
      undo(this.pose[name], f[name], 1e-3);
      if (this.truth) undo(this.truth[name], f['true_' + name], 1e-3);
    }
    undo(this.laserOf, f.laser);
    this.lasers = data.lasers;
    let at = this.ranges.length;
    for (const range of f.ranges) this.ranges.push(range);
    for (let i = this.size; i < this.time.length; ++i) {
      this.rangesBegin.push(at);
      at += this.lasers[this.laserOf[i]].beams;
    }
    for (const decision of data.decisions) {
      this.decisions.push(decision);
      this.decisionFrames.push(decision.frame);
    }
    const last = this.time.length - 1, bounded = (frames, column) => {
      const from = frames.length;
      undo(frames, column);
      for (let i = from; i < frames.length; ++i) frames[i] = Math.min(frames[i], last);
    };
    bounded(this.frontier.frame, data.frontier.frame);
    undo(this.frontier.x, data.frontier.x);
    undo(this.frontier.y, data.frontier.y);
    const l = data.lines, to = this.lines;
    bounded(to.frame, l.frame);
    undo(to.id, l.id);
    for (const name of ['x1', 'y1', 'x2', 'y2']) undo(to[name], l[name], 1e-3);
    undo(to.support, l.support);
    undo(to.sigmaOffset, l.sigma_offset, 1e-5);
    undo(to.sigmaAngle, l.sigma_angle, 1e-5);
    undo(this.coverage.distance, data.coverage.distance, 1e-3);
    undo(this.coverage.share, data.coverage.share, 1e-4);
  }

  get size() { return this.rangesBegin.length; }
  get begin() { return this.time[0]; }
  get duration() { return this.time[this.size - 1] - this.begin; }

  /** The last moment up to a time [s since the first]. */
  momentAt(time) { return Math.max(0, lastUpTo(this.time, this.begin + time + 1e-9)); }

  /** {x, y, theta, distance} at a time: between two moments the robot drives evenly. */
  poseAt(time, poses = this.pose) {
    const i = this.momentAt(time), k = Math.min(i + 1, this.size - 1);
    const span = this.time[k] - this.time[i];
    const dx = poses.x[k] - poses.x[i], dy = poses.y[k] - poses.y[i];
    const share = span > 0 && Math.hypot(dx, dy) < kJump
      ? Math.min(1, Math.max(0, (this.begin + time - this.time[i]) / span)) : 0;
    const turn = Math.atan2(Math.sin(poses.theta[k] - poses.theta[i]), Math.cos(poses.theta[k] - poses.theta[i]));
    return { x: poses.x[i] + share * dx, y: poses.y[i] + share * dy, theta: poses.theta[i] + share * turn,
             distance: this.distance[i] + share * (this.distance[k] - this.distance[i]) };
  }

  /** Goal, reason and way at a moment. */
  decisionAt(moment) {
    const i = lastUpTo(this.decisionFrames, moment);
    return i < 0 ? { goal: null, reason: '', way: [] } : this.decisions[i];
  }

  /** The outline of what the laser saw at a moment: [[x, y], ...] m. */
  scanAt(moment) {
    const laser = this.lasers[this.laserOf[moment]];
    const { x, y, theta } = this.pose;
    const c = Math.cos(theta[moment]), s = Math.sin(theta[moment]);
    const from = [x[moment] + 1e-3 * (c * laser.x - s * laser.y), y[moment] + 1e-3 * (s * laser.x + c * laser.y)];
    const points = [from];
    let range = 0, bearing = theta[moment] + 1e-3 * laser.theta + laser.first;
    for (let beam = 0, at = this.rangesBegin[moment]; beam < laser.beams; ++beam, ++at, bearing += laser.step) {
      range += this.ranges[at];
      const last = points[points.length - 1];
      if (range > 0) points.push([from[0] + 0.01 * range * Math.cos(bearing), from[1] + 0.01 * range * Math.sin(bearing)]);
      else if (last !== from) points.push(from);
    }
    return points;
  }

  /** m, how far the robot believed to be from where it was, at each moment; null where nobody knows. */
  poseErrors() {
    return this.truth && Array.from(this.time, (_, i) =>
      Math.hypot(this.pose.x[i] - this.truth.x[i], this.pose.y[i] - this.truth.y[i]));
  }

  /** m, sum of the lines' lengths at each moment. */
  mapLengths() {
    const lengths = new Float64Array(this.size), of = new Map(), { frame, id, support, x1, y1, x2, y2 } = this.lines;
    let sum = 0;
    for (let i = 0, k = 0; i < this.size; ++i) {
      for (; k < frame.length && frame[k] <= i; ++k) {
        const length = support[k] > 0 ? Math.hypot(x2[k] - x1[k], y2[k] - y1[k]) : 0;
        sum += length - (of.get(id[k]) || 0);
        of.set(id[k], length);
      }
      lengths[i] = sum;
    }
    return lengths;
  }
}

/** What of a run was there at a moment, where it is built up by changes: walks on from the last moment that was
 *  asked for, or anew from the first where the time goes back. */
class Changes {
  /** @param take  called with the index of each change, @param clear  with nothing. */
  constructor(frames, take, clear) { Object.assign(this, { frames, take, clear, next: 0, moment: -1 }); }
  /** @return whether anything is different now. */
  goTo(moment) {
    const before = this.next;
    const goesBack = moment < this.moment;
    if (goesBack) {
      this.next = 0;
      this.clear();
    }
    while (this.next < this.frames.length && this.frames[this.next] <= moment) this.take(this.next++);
    this.moment = moment;
    return goesBack || this.next !== before;
  }
}
