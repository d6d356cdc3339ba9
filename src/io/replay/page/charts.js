// SPDX-License-Identifier: BSD-3-Clause
// Curves over the distance driven, drawn by uPlot: one chart a quantity, one curve a run.
'use strict';

const kRunColours = ['line', 'second'];

/** [title, [[distances, values] of each run, or null where it knows nothing]] of each chart that has something. */
function curvesOf(runs) {
  const percent = (run) => run.coverage.share.length > 0 &&
    [run.coverage.distance, Array.from(run.coverage.share, (s) => 100 * s)];
  const error = (run) => run.truth && [run.distance, run.poseErrors().map((e) => 100 * e)];
  const length = (run) => [run.distance, run.mapLengths()];
  const charts = [['coverage, %', runs.map(percent)], ['pose error, cm', runs.map(error)], ['map, m of lines', runs.map(length)]];
  return charts.filter(([, curves]) => curves.some(Boolean)).slice(0, 2);
}

/** Curves as uPlot wants them. Where the robot stands several values share a distance: the last one counts. */
function tableOf(curves) {
  return uPlot.join(curves.map((curve) => {
    const of = new Map();
    if (curve) curve[0].forEach((distance, i) => of.set(distance, curve[1][i]));
    const known = Array.from(of.keys()).sort((a, b) => a - b);
    return [known, known.map((distance) => of.get(distance))];
  }));
}

class Chart {
  /** @param onSeek  called with the distance [m] that was clicked on. */
  constructor(element, title, curves, onSeek) {
    this.element = element;
    const axis = { stroke: () => colour('faint'), grid: { stroke: () => colour('edge'), width: 1 }, font: '11px system-ui' };
    this.plot = new uPlot({
      title, ...this.size(), legend: { show: false }, cursor: { drag: { x: false, y: false } },
      scales: { x: { time: false } },
      hooks: { ready: [() => this.mark()], setSize: [() => this.mark()] },
      axes: [{ ...axis, size: 26 }, { ...axis, size: 46 }],
      series: [{}, ...curves.map((_, i) => ({ stroke: () => colour(kRunColours[i]), width: 1.5, spanGaps: true, points: { show: false } }))],
    }, tableOf(curves), element);
    this.marks = curves.map((_, i) => {
      const mark = document.createElement('div');
      mark.className = i ? 'now second' : 'now';
      this.plot.over.appendChild(mark);
      return mark;
    });
    this.plot.over.addEventListener('click', (event) => onSeek(this.plot.posToVal(event.offsetX, 'x')));
    new ResizeObserver(() => this.plot.setSize(this.size())).observe(element);
  }

  /** Takes curves that have grown. */
  update(curves) {
    this.plot.setData(tableOf(curves));
    this.mark();
  }

  size() { return { width: Math.max(120, this.element.clientWidth), height: Math.max(60, this.element.clientHeight - 20) }; }

  /** Marks where each run is. */
  show(distances) {
    this.distances = distances;
    this.mark();
  }

  mark() {
    if (!this.marks || !this.distances) return;
    this.distances.forEach((distance, i) => { this.marks[i].style.left = this.plot.valToPos(distance, 'x') + 'px'; });
  }
}
