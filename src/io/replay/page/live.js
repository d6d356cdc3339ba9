// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on: its server tells what comes, and takes what its viewers want the robot to do.
'use strict';

const kChartsEvery = 1000;  // ms

class Live {
  constructor(player) {
    this.player = player;
    this.query = location.search;  // the token stands there
    this.isFollowing = true;
    this.robot = null;
    this.paused = false;
    this.hasRobot = false;
    this.ended = '';
    this.work = Promise.resolve();  // one event after the other
    this.makeBar();
    this.connect();
  }

  makeBar() {
    const bar = byId('live');
    bar.hidden = false;
    const button = (name, text, title, act) => {
      const made = Object.assign(document.createElement('button'), { id: name, textContent: text, title });
      made.addEventListener('click', act);
      bar.append(made);
      return made;
    };
    this.state = Object.assign(document.createElement('output'), { id: 'state' });
    this.state.setAttribute('aria-live', 'polite');
    button('follow', 'Live', 'Follow the run (l)', () => this.follow(true)).setAttribute('aria-pressed', true);
    button('pause', 'Pause', 'Pause or start the run (s)', () => this.ask({ do: this.paused ? 'start' : 'pause' }));
    button('stop', 'Stop', 'Stand still, and forget where to go (x)', () => this.ask({ do: 'stop' }));
    button('home', 'Home', 'Give up exploring, drive back to where it began (h)', () => this.ask({ do: 'home' }));
    button('go', 'Go there', 'Send the robot: a click on the map (g)', () => this.setSending(!this.isSending))
      .setAttribute('aria-pressed', false);
    bar.append(this.state);
    this.showState();
  }

  get isSending() { return byId('go').getAttribute('aria-pressed') === 'true'; }

  setSending(on) {
    if (on) this.player.setMeasuring(false);
    byId('go').setAttribute('aria-pressed', on && this.hasRobot);
    document.body.classList.toggle('sending', this.isSending);
  }

  /** A click on the map. @return whether it was one to send the robot by. */
  send(place) {
    if (!this.isSending) return false;
    const [x, y] = this.player.maps[0].run.origin;
    this.setSending(false);
    this.ask({ do: 'go', x: x + place.lng, y: y + place.lat });
    return true;
  }

  async ask(command) {
    try {
      const answer = await fetch('command' + this.query, { method: 'POST', body: JSON.stringify(command) });
      if (!answer.ok) this.tell(`${command.do}: ${(await answer.text()).trim()}`);
    } catch (error) {
      this.tell(`${command.do}: not heard, the connection is lost`);
    }
  }

  connect() {
    this.events = new EventSource('events' + this.query);
    this.events.onopen = () => { this.isLost = false; this.showState(); };
    this.events.onmessage = (event) => {
      this.work = this.work.then(() => this.take(JSON.parse(event.data)));
    };
    this.events.onerror = () => {
      if (this.ended) return this.events.close();
      this.isLost = true;
      this.showState();
      if (this.events.readyState !== EventSource.CLOSED) return;
      setTimeout(() => this.connect(), 1000);  // refused: the browser does not ask again by itself
    };
  }

  async take(told) {
    const { player } = this;
    if (told.whole) {
      const run = await Run.read(told.whole, true), old = player.maps[0]?.map;
      const view = old && !player.maps[0].isWhole ? [old.getCenter(), old.getZoom(), { animate: false }] : null;
      while (player.maps.length) player.removeLastRun();
      player.addRun(run);
      if (view) player.maps[0].map.setView(...view);
      document.title = run.title + ' - cca-mrpt live';
    }
    this.robot = told.robot ?? this.robot;
    Object.assign(this, { paused: told.paused, hasRobot: told.has_robot, ended: told.end });
    if (player.maps.length) {
      if (told.more) player.maps[0].append(told.more);
      this.showCharts();
      this.show();
    }
    if (this.ended) this.events.close();
    this.showState();
  }

  /** Shows what is known last, where that is wanted. */
  show() {
    const { player } = this;
    byId('timeline').max = player.duration;
    if (!this.isFollowing) return player.show(player.time);
    player.show(player.duration);
    const [view] = player.maps;
    if (!this.robot || this.ended) return;
    view.drawRobot(this.robot);
    view.reason.textContent = this.robot.reason;
  }

  /** Charts are drawn anew once in a while: each time all of them is. */
  showCharts() {
    if (this.chartsWait && !this.ended) return;
    this.chartsWait = true;
    setTimeout(() => { this.chartsWait = false; }, kChartsEvery);
    this.player.updateCharts();
  }

  follow(on) {
    this.isFollowing = on;
    byId('follow').setAttribute('aria-pressed', on);
    if (on && this.player.maps.length) this.show();
  }

  showState() {
    const text = this.ended ? 'ended: ' + this.ended : this.isLost ? 'connection lost, asking again' : this.paused ? 'paused' : 'live';
    this.state.textContent = text;
    document.body.classList.toggle('lost', !!this.isLost && !this.ended);
    byId('pause').textContent = this.paused ? 'Start' : 'Pause';
    for (const name of ['pause', 'stop', 'home', 'go']) {
      byId(name).disabled = !!this.ended || !!this.isLost || (!this.hasRobot && name !== 'pause');
      byId(name).hidden = !this.hasRobot && name !== 'pause';
    }
    if (this.ended) this.setSending(false);
  }

  tell(text) { this.state.textContent = text; }

  /** What a key does here; undefined: nothing. */
  actionOf(key) {
    const click = (name) => () => byId(name).click();
    return { l: click('follow'), s: click('pause'), x: click('stop'), h: click('home'), g: click('go') }[key];
  }
}
