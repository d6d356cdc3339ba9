#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""replay.html as a user meets it, in a headless Chromium that is driven by its DevTools protocol.

replay_page_test.py CCA_MRPT_PROGRAM MAPS_FOLDER [--keep DIR]   exit status 77: there is no Chromium

Two pages are looked at: that of an exploration, for what the user does, and the same page with a small run
written here, whose picture is known to the pixel (replay_map.png; --keep leaves the one of this run).
"""
import base64
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zlib

from PIL import Image, ImageChops, ImageStat

HERE = os.path.dirname(os.path.abspath(__file__))
RUN = re.compile(r'(<script type="application/octet-stream" class="run">)([^<]*)(</script>)')
PATIENCE = 60  # s, for a busy machine


class Browser:
    """A Chromium without a window. Messages end with a zero byte, on file descriptors 3 and 4 of its own."""

    def __init__(self, program, profile):
        to_browser, self.requests = os.pipe()
        self.answers, from_browser = os.pipe()

        def connect():
            os.dup2(os.dup(to_browser), 60), os.dup2(os.dup(from_browser), 61)
            os.dup2(60, 3), os.dup2(61, 4)
            os.closerange(5, 62)

        self.process = subprocess.Popen(
            [program, '--headless=new', '--no-sandbox', '--disable-gpu', '--remote-debugging-pipe',
             '--no-first-run', '--hide-scrollbars', '--force-device-scale-factor=1', '--disable-dev-shm-usage',
             f'--user-data-dir={profile}', 'about:blank'],
            preexec_fn=connect, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser), os.close(from_browser)
        self.buffer, self.number, self.session, self.errors, self.asked = b'', 0, None, [], []
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self.session = self.call('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in 'Page', 'Runtime', 'Network', 'Log':
            self.call(domain + '.enable')

    def read(self):
        while b'\0' not in self.buffer:
            part = os.read(self.answers, 1 << 20)
            if not part:
                raise RuntimeError('Chromium has ended')
            self.buffer += part
        message, self.buffer = self.buffer.split(b'\0', 1)
        message = json.loads(message)
        method, values = message.get('method'), message.get('params', {})
        if method == 'Runtime.exceptionThrown':
            self.errors.append(values['exceptionDetails'].get('exception', {}).get('description', 'error'))
        if method == 'Log.entryAdded' and values['entry']['level'] == 'error':
            self.errors.append(values['entry']['text'])
        if method == 'Network.requestWillBeSent':
            self.asked.append(values['request']['url'])
        return message

    def call(self, method, **values):
        self.number += 1
        request = {'id': self.number, 'method': method, 'params': values}
        if self.session:
            request['sessionId'] = self.session
        os.write(self.requests, json.dumps(request).encode() + b'\0')
        while True:
            answer = self.read()
            if answer.get('id') == self.number:
                if 'error' in answer:
                    raise RuntimeError(f'{method}: {answer["error"]}')
                return answer['result']

    def run(self, script):
        """The value of an expression; promises are awaited."""
        result = self.call('Runtime.evaluate', expression=script, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in result:
            raise RuntimeError(script + ': ' + json.dumps(result['exceptionDetails'])[:400])
        return result['result'].get('value')

    def wait(self, script):
        begin = time.time()
        while not self.run(script):
            if time.time() - begin > PATIENCE:
                raise RuntimeError('in vain: ' + script)
            time.sleep(0.05)

    def open(self, path, width=1000, height=800, dark=False):
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1,
                  mobile=width < 600)
        self.call('Emulation.setEmulatedMedia',
                  features=[{'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}])
        self.call('Page.navigate', url='about:blank')
        self.call('Page.navigate', url='file://' + path)
        self.wait('!!window.player')
        self.settle()

    def settle(self):
        self.run('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 100))))')

    def picture(self, of=None):
        box = self.run(f'''(() => {{ const b = document.querySelector({of!r}).getBoundingClientRect();
            return [b.x, b.y, b.width, b.height]; }})()''') if of else None
        clip = {'clip': dict(zip(('x', 'y', 'width', 'height'), box), scale=1)} if box else {}
        data = self.call('Page.captureScreenshot', format='png', **clip)['data']
        return Image.open(io.BytesIO(base64.b64decode(data))).convert('RGB')

    def mouse(self, kind, x, y):
        pressed = {'button': 'left', 'clickCount': 1} if kind != 'mouseMoved' else {}
        self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, **pressed)

    def click(self, x, y):
        self.mouse('mouseMoved', x, y), self.mouse('mousePressed', x, y), self.mouse('mouseReleased', x, y)

    def press(self, key, code=0):
        text = {'text': key} if len(key) == 1 else {}
        self.call('Input.dispatchKeyEvent', type='keyDown', key=key, windowsVirtualKeyCode=code, **text)
        self.call('Input.dispatchKeyEvent', type='keyUp', key=key, windowsVirtualKeyCode=code)

    def close(self):
        try:
            self.call('Browser.close')
        except (RuntimeError, OSError):
            pass
        self.process.wait(PATIENCE)


def differences(column):
    return [b - a for a, b in zip([0] + column, column)]


def small_run():
    """Ten seconds in a room of 8 x 6 m of which a wall comes to be known each second."""
    moments, beams = 11, 91
    ends = [(0, 0, 8, 0), (8, 0, 8, 6), (8, 6, 3, 6), (0, 6, 0, 0)]
    changes = [(2 * k + 1, k + 1, *[1000 * v for v in wall], 50 * (k + 1), 120, 340) for k, wall in enumerate(ends)]
    changes += [(8, 9, 2000, 2000, 3000, 3000, 5, 500, 900), (10, 9, 2000, 2000, 3000, 3000, 0, 0, 0)]
    wall_cells = [[x in (0, 79) or y in (0, 59) for x in range(80)] for y in range(60)]
    runs, last, length = [], False, 0
    for cell in sum(wall_cells, []):
        if cell != last:
            runs.append(length)
            last, length = cell, 0
        length += 1
    column = lambda values: differences(list(values))
    frames = {
        'time': column(1000 * k for k in range(moments)), 'distance': column(500 * k for k in range(moments)),
        'x': column(1500 + 500 * k for k in range(moments)), 'y': [3000] + [0] * (moments - 1),
        'theta': [0] * moments, 'true_x': column(1500 + 490 * k for k in range(moments)),
        'true_y': [3000] + [0] * (moments - 1), 'true_theta': [0] * moments, 'laser': [0] * moments,
        'ranges': ([150] + [0] * (beams - 1)) * moments}
    named = lambda rows, names: {n: column(row[i] for row in rows) for i, n in enumerate(names)}
    return {
        'title': 'room', 'origin': [100, 200], 'robot_radius': 0.25, 'frontier_block': 0.2,
        'world': {'width': 80, 'height': 60, 'resolution': 0.1, 'x': 0, 'y': 0, 'runs': runs + [length]},
        'lasers': [{'x': 0, 'y': 0, 'theta': 0, 'first': -math.pi / 2, 'step': math.pi / 90, 'beams': beams}],
        'frames': frames,
        'decisions': [{'frame': 0, 'goal': [7000, 5000], 'reason': 'the nearest frontier', 'way': [1500, 3000, 7000, 5000]},
                      {'frame': 6, 'goal': None, 'reason': 'all is seen', 'way': []}],
        'frontier': named([(1, 30, 10), (1, 31, 10), (5, 30, 10)], ('frame', 'x', 'y')),
        'lines': named(sorted(changes), ('frame', 'id', 'x1', 'y1', 'x2', 'y2', 'support', 'sigma_offset', 'sigma_angle')),
        'coverage': {'distance': column(500 * k for k in range(moments)), 'share': column(1000 * k for k in range(moments))}}


def with_run(page, run, rooms=None):
    packed = '.'.join(base64.b64encode(zlib.compress(json.dumps(part).encode())).decode()
                      for part in (run, rooms) if part is not None)
    return RUN.sub(lambda found: found[1] + packed + found[3], page, count=1)


failures = []


def check(holds, what):
    if not holds:
        failures.append(what)
        print('FAILED:', what)


def place_of(browser, x, y):
    """Where a place of the map stands on the page."""
    return browser.run(f'''(() => {{ const m = player.maps[0].map, b = m.getContainer().getBoundingClientRect();
        const p = m.latLngToContainerPoint([{y}, {x}]); return [b.x + p.x, b.y + p.y]; }})()''')


def test_small_run(browser, page, keep):
    browser.open(page)
    state = lambda: browser.run('[player.maps[0].drawn.size, player.maps[0].blocks.size, player.time]')
    check(state() == [4, 1, 10], f'opens with the finished map: {state()}')

    # Scrubbing: forwards, backwards, and what each time shows.
    for moment, lines, blocks in (0, 0, 0), (1, 1, 2), (9, 5, 1), (4, 2, 2), (10, 4, 1), (3.5, 2, 2):
        browser.run(f'''(() => {{ const t = document.getElementById('timeline'); t.value = {moment};
            t.dispatchEvent(new Event('input')); }})()''')
        check(state() == [lines, blocks, moment], f'at {moment} s: {state()}')
    check(browser.run('player.maps[0].reason.textContent') == 'the nearest frontier', 'reason of the goal')
    x = browser.run('player.maps[0].run.poseAt(3.5).x')
    check(abs(x - 3.25) < 1e-6, f'between two moments the robot drives evenly: {x}')

    # The picture.
    browser.run('player.show(10)')
    browser.settle()
    now = browser.picture('.map')
    if keep:
        now.save(os.path.join(keep, 'replay_map.png'))
    known = Image.open(os.path.join(HERE, 'replay_map.png')).convert('RGB')
    check(now.size == known.size, f'the map is {now.size}, was {known.size}')
    if now.size == known.size:
        # Fonts differ from machine to machine: the scale's corner and the buttons are left out.
        box = (60, 0, now.width, now.height - 40)
        difference = ImageChops.difference(now.crop(box), known.crop(box)).convert('L')
        far = sum(difference.histogram()[48:]) / (difference.width * difference.height)
        check(far < 0.002, f'{100 * far:.2f} % of the map look other than in replay_map.png')

    # Hovering tells of a line, in the map frame.
    for y in 3.1, 3.05, 3.0:  # as a hand would; Leaflet looks at it 30 times a second
        browser.mouse('mouseMoved', *place_of(browser, 8, y))
        time.sleep(0.1)
    browser.wait("!!document.querySelector('.leaflet-tooltip')")
    told = browser.run("document.querySelector('.leaflet-tooltip').innerText")
    for part in 'line 2', 'length 6.000 m', '100 returns', '1.20 mm', '0.195 deg', '108.000, 200.000', '108.000, 206.000':
        check(part in told, f'hovering does not tell "{part}": {told!r}')

    # Measuring.
    browser.press('m')
    browser.click(*place_of(browser, 1, 1))
    browser.click(*place_of(browser, 4, 5))
    measured = browser.run("document.getElementById('measured').textContent")
    check(abs(float(measured.split()[0]) - 5) < 0.05, f'3 and 4 m make {measured}')
    browser.press('Escape')

    # Measuring snaps to ends of lines, and tells both ways.
    browser.press('m')
    for x, y in (0.1, 0.08), (7.93, 6.05):
        browser.click(*place_of(browser, x, y))
    measured = browser.run("document.getElementById('measured').textContent")
    check(measured == '10.000 m, 36.9 deg, 8.000 m by 6.000 m', f'the room measures {measured}')
    browser.press('Escape')

    # A click chooses a wall, another one by its id; files hold what is chosen and seen.
    text = lambda: browser.run("document.getElementById('selected').textContent")
    is_hidden = lambda: browser.run("document.getElementById('selection').hidden")
    check(is_hidden(), 'nothing is chosen at first')
    browser.click(*place_of(browser, 8, 3))
    for part in 'line 2', 'length 6.000 m', '100 returns', '1.20 mm', 'seen since 0:03':
        check(part in text(), f'the chosen wall does not tell "{part}": {text()!r}')
    rows = browser.run('player.selection.csv()').splitlines()
    check(rows[1].startswith('108.0000,200.0000,108.0000,206.0000,2,100,6.0000,'), f'the table: {rows}')
    drawing = browser.run('player.selection.svg()')
    check(drawing.count('<line ') == 4 and drawing.count('stroke-width="5"') == 1, f'the drawing: {drawing}')
    browser.run("(() => { const f = document.getElementById('find'); f.value = 99; f.dispatchEvent(new Event('change')); })()")
    check(text() == 'no line 99 at this time', f'a line that is not there: {text()!r}')
    browser.run("(() => { const f = document.getElementById('find'); f.value = 1; f.dispatchEvent(new Event('change')); })()")
    check(text().startswith('line 1,'), f'found by its id: {text()!r}')
    browser.press('Escape')
    check(is_hidden(), 'escape chooses nothing')
    browser.press('0')

    # Layers, by mouse and by key.
    browser.run("document.querySelector('#layers input[name=lines]').click()")
    check(not browser.run('player.maps[0].map.hasLayer(player.maps[0].layers.lines)'), 'lines are hidden')
    browser.press('1')
    check(browser.run('player.maps[0].map.hasLayer(player.maps[0].layers.lines)'), 'key 1 shows the lines')

    # A click in a chart goes there; the error is the one between the two paths.
    browser.run('player.seekDistance(2.0)')
    check(browser.run('player.time') == 4, 'seeks the distance')
    check(abs(browser.run('player.maps[0].run.poseErrors()[10]') - 0.1) < 1e-9, 'pose error')
    check(browser.run('player.charts.length') == 2, 'two charts')


def test_rooms(browser, page, path):
    """Rooms are those of the finished map; a name is shown as it is written; lines keep the mouse."""
    rooms = [{'id': 1, 'name': '<b>hall</b>', 'area': 23.04,
              'rings': [[0, 0, 4000, 0, 4000, 6000, 0, 6000], [1000, 4000, 1000, 5000, 2000, 5000, 2000, 4000]]},
             {'id': 2, 'name': '', 'area': 24, 'rings': [[4000, 0, 8000, 0, 8000, 6000, 4000, 6000]]}]
    with open(page, encoding='utf-8') as file:
        text = with_run(file.read(), small_run(), rooms)
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
    browser.open(path)

    def told_at(*places):
        for place in places:  # as a hand would
            browser.mouse('mouseMoved', *place_of(browser, *place))
            time.sleep(0.1)
        return browser.run("document.querySelector('.leaflet-tooltip')?.innerText ?? ''")

    drawn = lambda: browser.run('player.maps[0].layers.rooms.getLayers().length')
    check(drawn() == 2, f'{drawn()} rooms')
    check(told_at((3, 1.4), (3, 1.5)) == '<b>hall</b>, 23.0 m\u00b2', f'in the hall: {told_at((3, 1.5))!r}')
    check(told_at((5, 1.4), (5, 1.5)) == 'room 2, 24.0 m\u00b2', f'in room 2: {told_at((5, 1.5))!r}')
    check(told_at((1.4, 4.5), (1.5, 4.5)) == '', f'in the hole: {told_at((1.5, 4.5))!r}')
    check('line 2' in told_at((7.9, 3), (8, 3)), f'on the wall: {told_at((8, 3))!r}')
    for _ in range(2):  # hides the rooms and shows them again: under the lines, as before
        browser.run("document.querySelector('#layers input[name=rooms]').click()")
    check('line 2' in told_at((7.9, 2), (8, 2)), f'on the wall, later: {told_at((8, 2))!r}')
    browser.run('player.show(5)')
    check(drawn() == 0, 'rooms of the finished map stand in one that is not finished')
    browser.run('player.show(10)')
    check(drawn() == 2, 'rooms are back at the end')
    browser.open(page)
    boxes = browser.run("Array.from(document.querySelectorAll('#layers input'), (box) => box.name)")
    check('rooms' not in boxes, f'boxes of a run without plan: {boxes}')


SIZES = {'desk': (1000, 800), 'phone': (360, 740), 'phone lying': (740, 360)}


def test_keys_after_a_click(browser, page):
    """Who has clicked on the map, as everybody does first, drives the player by keys as before."""
    for name, (width, height) in SIZES.items():
        browser.open(page, width, height)
        x, y, w, h = browser.run('''(() => { const b = document.querySelector('.map').getBoundingClientRect();
            return [b.x, b.y, b.width, b.height]; })()''')
        time_of = lambda: browser.run('player.time')
        view = browser.run('String(player.maps[0].map.getCenter())')
        browser.click(x + 0.7 * w, y + 0.4 * h)
        check(browser.run("document.activeElement.matches('.map')"), f'{name}: the click is on the map')
        for key, code, expected in (('Home', 36, 0), ('ArrowRight', 39, 1), ('End', 35, 10), ('ArrowLeft', 37, 9)):
            browser.press(key, code)
            check(time_of() == expected, f'{name}: {key} after a click leads to {time_of()} s')
        check(browser.run('String(player.maps[0].map.getCenter())') == view, f'{name}: the map stays where it was')
        browser.press('Home', 36)
        browser.press(' ', 32)
        check(browser.run('player.isPlaying') or time_of() > 0, f'{name}: space plays')
        browser.run('player.play(false)')
        speed = browser.run("document.getElementById('speed').selectedIndex")
        browser.press('+')
        check(browser.run("document.getElementById('speed').selectedIndex") == speed + 1, f'{name}: +')
        browser.press('1')
        check(browser.run("player.hidden.has('lines')"), f'{name}: 1')
        browser.press('m')
        check(browser.run('player.isMeasuring'), f'{name}: m')
        browser.press('Escape', 27)
        check(not browser.run('player.isMeasuring'), f'{name}: escape')

    # Who comes to the map by the tab key moves it.
    browser.open(page)
    browser.press('Tab', 9)
    check(browser.run("document.activeElement.matches('.map')"), 'tab leads to the map first')
    before = browser.run('player.maps[0].map.getCenter().lng')
    browser.press('ArrowRight', 39)
    check(browser.run('player.maps[0].map.getCenter().lng') > before, 'right moves the map that has the focus')
    check(browser.run('player.time') == 10, 'and not the time')


def test_sizes(browser, page, keep):
    """Fingers hit everything, nothing sticks out, and the map keeps its share, at a desk and on a phone."""
    least = {'desk': 0.45 * 800, 'phone': 740 / 3, 'phone lying': 0.6 * 360}
    for name, (width, height) in SIZES.items():
        browser.open(page, width, height)
        browser.run('player.selection.select(player.maps[0], 2)')
        if keep:
            browser.picture().save(os.path.join(keep, name.replace(' ', '_') + '.png'))
        page_width, page_height, map_height = browser.run('''[document.documentElement.scrollWidth,
            document.documentElement.scrollHeight, document.querySelector('.map').clientHeight]''')
        check(page_width <= width and page_height <= height, f'{name}: the page is {page_width} x {page_height}')
        check(map_height >= least[name], f'{name}: the map is {map_height} pixels high')
        small = browser.run('''Array.from(document.querySelectorAll('button, select, #timeline, #find, label, .leaflet-bar a'))
            .map((e) => [e.id || e.textContent.trim(), e.getBoundingClientRect()])
            .filter(([, b]) => b.width < 44 || b.height < 44).map(([n, b]) => `${n} ${b.width} x ${b.height}`)''')
        check(not small, f'{name}: smaller than a finger: {small}')


def luminance(colour):
    channels = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return sum(share * c for share, c in zip((0.2126, 0.7152, 0.0722), linear))


def contrast(a, b):
    """Of WCAG 2.2: 4.5 for text, 3 for what else must be told apart."""
    light, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def test_contrast(browser, page):
    for dark in False, True:
        browser.open(page, dark=dark)
        of = lambda name: browser.run(f'colour({name!r})')
        for text in 'ink', 'faint':
            for ground in 'ground', 'control':
                ratio = contrast(of(text), of(ground))
                check(ratio >= 4.5, f'dark {dark}: {text} on {ground}: {ratio:.2f}')
        for name in 'line', 'room', 'scan', 'frontier', 'way', 'path', 'truth', 'robot':
            for ground in 'floor', 'unknown':
                ratio = contrast(of(name), of(ground))
                check(ratio >= 3, f'dark {dark}: {name} on {ground}: {ratio:.2f}')
        check(contrast(of('floor'), of('unknown')) > 1.25, 'floor is told from what nobody has seen')
        check(of('way') == browser.run('player.maps[0].goal.options.color'), 'the goal is as its legend')


def test_opening(browser, page, path):
    """The walls come first; floor that was seen is told from what nobody knows; a log has no true world."""
    browser.open(page)
    check(browser.run('Array.from(player.hidden).sort().join()') == 'believed path,true path', 'paths wait')
    picture, ratio = browser.picture(), 1
    seen, unknown = (picture.getpixel(tuple(round(ratio * v) for v in place_of(browser, *at))) for at in ((3, 3.5), (4, 1.2)))
    check(seen == (255, 255, 255) and unknown != seen, f'seen floor is {seen}, what is unknown {unknown}')
    browser.run('player.show(0)')
    browser.settle()
    later = browser.picture().getpixel(tuple(round(v) for v in place_of(browser, 5, 3.5)))
    check(later == unknown, f'floor that is seen later is {later} at first, unknown {unknown}')
    with open(page, encoding='utf-8') as file:
        text = with_run(file.read(), {**small_run(), 'world': None})
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
    browser.open(path)
    boxes = browser.run("Array.from(document.querySelectorAll('#layers input'), (box) => box.name)")
    check('true world' not in boxes and 'lines' in boxes, f'boxes of a log: {boxes}')


def test_address(browser, page):
    browser.open(page + '#t=3.5')
    check(browser.run('player.time') == 3.5, '#t=3.5')
    browser.wait("location.hash.includes('view=')")  # the view that the page opened with, which is another
    check(not browser.run('location.hash').endswith(',5.00'), 'the page opens with another zoom than the one asked for below')
    browser.run("document.querySelector('#layers input[name=scan]').click()")
    browser.run('void player.maps[0].map.setView([2, 3], 5, {animate: false})')
    browser.wait("location.hash.endsWith(',5.00')")
    address = browser.run('location.hash')
    x, y, _ = map(float, address.split('view=')[1].split(','))
    check(math.hypot(x - 3, y - 2) < 0.05, f'view in {address}')  # Leaflet stops at whole pixels
    check('t=3.5&' in address and 'scan' not in address and 'lines' in address, f'address {address}')
    browser.open(page + address)
    state = browser.run("[player.time, player.hidden.has('scan'), player.maps[0].map.getZoom()]")
    check(state == [3.5, True, 5], f'the address gives {state}')
    for odd in '#t=', '#t=far', '#view=1,2', '#layers=none&view=,,', '#%':
        browser.open(page + odd)
        check(browser.run('player.time') == 10, f'{odd} shows the end')


def test_stray_pose(browser, path, run):
    """One pose at 1e7 m: the map is shown as before."""
    run['frames']['x'][5:7] = [10**10, 1000 - 10**10]
    with open(path, encoding='utf-8') as file:
        page = with_run(file.read(), run)
    with open(path, 'w', encoding='utf-8') as file:
        file.write(page)
    browser.open(path)
    width = browser.run("player.maps[0].map.getBounds().getEast() - player.maps[0].map.getBounds().getWest()")
    check(8 < width < 30, f'the map shows {width} m of a room of 8 m')


def test_exploration(browser, page, keep):
    begin = time.time()
    browser.open(page)
    drawn = browser.run('performance.getEntriesByType("paint").map((e) => e.startTime)')
    print(f'two_rooms: {os.path.getsize(page)} bytes, first paint after {drawn} ms, ready in {time.time() - begin:.2f} s')
    check(browser.run('player.maps[0].drawn.size') > 5, 'lines')
    check(browser.run('player.maps[0].run.rooms.length') == 2, 'two rooms')
    check(browser.run('player.charts.length') == 2, 'coverage and pose error')
    check(abs(browser.run('player.maps[0].run.coverage.share.at(-1)') - 1) < 0.02, 'coverage at the end')

    # Keys: home, right, end, speed, play and pause.
    browser.press('Home', 36)
    check(browser.run('player.time') == 0, 'Home')
    browser.press('ArrowRight', 39)
    check(browser.run('player.time') == 1, 'right')
    speed = lambda: browser.run("document.getElementById('speed').value")
    browser.press('+')
    check(speed() == '20', f'+: {speed()}')
    browser.press('-')
    browser.press(' ', 32)
    browser.wait('player.time > 3')
    browser.press(' ', 32)
    check(not browser.run('player.isPlaying'), 'paused')

    # Smooth: what it takes to draw a picture, over the whole run.
    spent = browser.run('''(() => { const n = 200, begin = performance.now();
        for (let k = 0; k <= n; ++k) player.show(player.duration * k / n);
        return (performance.now() - begin) / n; })()''')
    print(f'{spent:.1f} ms to show a moment')
    check(spent < 1000 / 30, f'{spent:.1f} ms a picture is less than 30 in a second')

    # Dark is dark.
    browser.open(page, dark=True)
    dark = ImageStat.Stat(browser.picture().convert('L')).mean[0]
    browser.call('Emulation.setEmulatedMedia', features=[{'name': 'prefers-color-scheme', 'value': 'light'}])
    browser.settle()
    light = ImageStat.Stat(browser.picture().convert('L')).mean[0]
    check(dark < 70 and light > 180, f'mean grey {dark:.0f} in the dark, {light:.0f} in the light')

    # A phone: nothing sticks out, the map keeps a third of the height.
    browser.open(page, width=360, height=740)
    sizes = browser.run('''[document.documentElement.scrollWidth, document.documentElement.scrollHeight,
        document.querySelector('.map').clientHeight]''')
    check(sizes[0] <= 360 and sizes[1] <= 740 and sizes[2] >= 740 / 3, f'on a phone: {sizes}')
    if keep:
        browser.picture().save(os.path.join(keep, 'phone.png'))


def test_two_runs(browser, page, keep):
    browser.open(page)
    check(browser.run('player.maps.length') == 2, 'two runs')
    browser.run('void player.maps[0].map.setView([2, 3], 6, {animate: false})')
    check(browser.run('player.maps[1].map.getZoom()') == 6, 'maps move as one')
    if keep:
        browser.run('player.showWhole()')
        browser.run('player.show(player.duration / 2)')
        browser.settle()
        browser.picture().save(os.path.join(keep, 'two_runs.png'))


def main():
    program, maps = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    keep = os.path.abspath(sys.argv[4]) if sys.argv[3:4] == ['--keep'] else None
    chromium = shutil.which('chromium') or shutil.which('google-chrome')
    if not chromium:
        print('SKIPPED: there is no Chromium')
        return 77
    with tempfile.TemporaryDirectory() as work:
        run, other, small, both = (os.path.join(work, name) for name in ('a', 'b', 'small.html', 'both.html'))
        for seed, folder in ('3', run), ('4', other):
            subprocess.run([program, 'explore', maps + '/two_rooms.yaml', '--seed', seed, '--pose', 'odometry', '--out',
                            folder, '--quiet'], check=True)
        page = run + '/replay.html'
        with open(page, encoding='utf-8') as file, open(small, 'w', encoding='utf-8') as changed:
            changed.write(with_run(file.read(), small_run()))
        subprocess.run([program, 'render', run, '--html', '--beside', other, '--out', both], check=True)
        browser = Browser(chromium, work + '/profile')
        try:
            test_small_run(browser, small, keep)
            test_rooms(browser, small, work + '/rooms.html')
            test_keys_after_a_click(browser, small)
            test_sizes(browser, page, keep)
            test_contrast(browser, small)
            test_opening(browser, small, work + '/log.html')
            test_address(browser, small)
            test_stray_pose(browser, small, small_run())
            test_exploration(browser, page, keep)
            test_two_runs(browser, both, keep)
        finally:
            browser.close()
        check(not browser.errors, f'errors: {browser.errors}')
        outside = [url for url in browser.asked if not url.startswith(('file:', 'data:', 'about:', 'blob:'))]
        check(not outside, f'asks the network for {outside}')
    print('replay: ' + (f'{len(failures)} failure(s)' if failures else 'passed'))
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
