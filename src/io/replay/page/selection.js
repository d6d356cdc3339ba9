// SPDX-License-Identifier: BSD-3-Clause
// Which lines somebody has chosen: what is told of them, and the view and they as files.
'use strict';

const kSnap = 14;  // pixels: a finger or a mouse that is so near an end means it

function save(name, address) { Object.assign(document.createElement('a'), { download: name, href: address }).click(); }

const inFile = (kind, text) => `data:${kind};charset=utf-8,${encodeURIComponent(text)}`;

class Selection {
  constructor(player) {
    this.player = player;
    this.view = null;
    byId('find').addEventListener('change', (event) => this.find(event.target.value));
    byId('save-svg').addEventListener('click', () => save('view.svg', inFile('image/svg+xml', this.svg())));
    byId('save-png').addEventListener('click', () => this.savePng());
    byId('save-csv').addEventListener('click', () => save('lines.csv', inFile('text/csv', this.csv())));
  }

  /** Chooses a line, or one more, or one less. @param id  undefined: none. */
  select(view, id, adds) {
    for (const { chosen } of this.player.maps) if (!adds) chosen.clear();
    if (id !== undefined && !view.chosen.delete(id)) view.chosen.add(id);
    this.view = view;
    for (const map of this.player.maps) map.paintLines();
    this.tell();
  }

  find(number) {
    const view = this.player.maps.find(({ drawn }) => drawn.has(Number(number)));
    if (!number || !view) return this.tell(number && `no line ${number} at this time`);
    this.select(view, Number(number), false);
    view.map.panTo(view.drawn.get(Number(number)).getBounds().getCenter(), { animate: false });
  }

  get lines() { return this.view ? [...this.view.chosen].filter((id) => this.view.drawn.has(id)) : []; }

  tell(instead) {
    const { lines, view } = this;
    byId('selection').hidden = !instead && !lines.length;
    byId('save-csv').hidden = !lines.length;
    byId('selected').textContent = instead || (lines.length === 1 ? view.facts(lines[0]).join(', ')
      : `${lines.length} lines, ${lines.reduce((sum, id) => sum + view.lengthOf(id), 0).toFixed(3)} m`);
  }

  csv() {
    const rows = this.lines.map((id) => {
      const l = this.view.run.lines, i = this.view.now.get(id), [ox, oy] = this.view.run.origin;
      return [...[ox + l.x1[i], oy + l.y1[i], ox + l.x2[i], oy + l.y2[i]].map((x) => x.toFixed(4)), id, l.support[i],
              this.view.lengthOf(id).toFixed(4), l.sigmaOffset[i], l.sigmaAngle[i] * 180 / Math.PI].join();
    });
    return ['x1,y1,x2,y2,id,support,length,sigma_offset,sigma_angle_deg', ...rows, ''].join('\n');
  }

  /** The lines that are seen, as a drawing of the view's size; 1 unit is a pixel. */
  svg() {
    const { map, drawn, chosen } = this.view ?? this.player.maps[0], { x: width, y: height } = map.getSize();
    const parts = [];
    for (const [id, line] of drawn) {
      const [a, b] = line.getLatLngs().map((place) => map.latLngToContainerPoint(place));
      const isOff = (k, size) => Math.max(a[k], b[k]) < 0 || Math.min(a[k], b[k]) > size;
      if (isOff('x', width) || isOff('y', height)) continue;
      const isChosen = chosen.has(id);
      parts.push(`<line id="line${id}" x1="${a.x}" y1="${a.y}" x2="${b.x}" y2="${b.y}" stroke="${colour(isChosen ? 'robot' : 'line')}"`
                 + ` stroke-width="${isChosen ? 5 : 2.5}"/>`);
    }
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">`
           + `<rect width="100%" height="100%" fill="${colour('floor')}"/><g stroke-linecap="round">${parts.join('')}</g></svg>\n`;
  }

  async savePng() {
    const picture = new Image();
    picture.src = inFile('image/svg+xml', this.svg());
    await picture.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: 2 * picture.width, height: 2 * picture.height });
    canvas.getContext('2d').drawImage(picture, 0, 0, canvas.width, canvas.height);
    save('view.png', canvas.toDataURL());
  }
}
