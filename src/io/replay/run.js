// SPDX-License-Identifier: BSD-3-Clause
// A run, as Replay::packed() in C++ has put it, and what it was at each moment.
'use strict';

const kJump = 1.0;  // m, between two moments: a correction, not a drive

/** The numbers of which a column holds the differences. @param unit  of one of them. */
function undo(column, unit = 1) {
  const numbers = new Float64Array(column.length);
  let sum = 0;
  for (let i = 0; i < column.length; ++i) numbers[i] = (sum += column[i]) * unit;
  return numbers;
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
  static async read(base64) { return new Run(JSON.parse(await unpack(base64))); }

  constructor(data) {
    this.title = data.title;
    this.origin = data.origin;  // m, map frame
    this.robotRadius = data.robot_radius;
    this.block = data.frontier_block;
    this.world = data.world;
    const f = data.frames;
    this.time = undo(f.time, 1e-3);
    this.distance = undo(f.distance, 1e-3);
    this.pose = { x: undo(f.x, 1e-3), y: undo(f.y, 1e-3), theta: undo(f.theta, 1e-3) };
    this.truth = f.true_x && { x: undo(f.true_x, 1e-3), y: undo(f.true_y, 1e-3), theta: undo(f.true_theta, 1e-3) };
    this.size = this.time.length;
    if (this.truth && this.poseErrors().every((error) => error === 0)) this.truth = null;  // they are the same
    this.begin = this.time[0];
    this.duration = this.time[this.size - 1] - this.begin;
    this.laserOf = undo(f.laser);
    this.lasers = data.lasers;
    this.ranges = f.ranges;
    this.rangesBegin = [];
    let at = 0;
    for (const laser of this.laserOf) {
      this.rangesBegin.push(at);
      at += this.lasers[laser].beams;
    }
    this.decisions = data.decisions;
    this.decisionFrames = this.decisions.map((d) => d.frame);
    const last = this.size - 1, bounded = (frames) => frames.map((i) => Math.min(i, last));
    this.frontier = { frame: bounded(undo(data.frontier.frame)), x: undo(data.frontier.x), y: undo(data.frontier.y) };
    const l = data.lines;
    this.lines = { frame: bounded(undo(l.frame)), id: undo(l.id),
                   x1: undo(l.x1, 1e-3), y1: undo(l.y1, 1e-3), x2: undo(l.x2, 1e-3), y2: undo(l.y2, 1e-3),
                   support: undo(l.support), sigmaOffset: undo(l.sigma_offset, 1e-5), sigmaAngle: undo(l.sigma_angle, 1e-5) };
    this.coverage = { distance: undo(data.coverage.distance, 1e-3), share: undo(data.coverage.share, 1e-4) };
  }

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
