#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The live page as a user meets it, in a headless Chromium.

live_browser_test.py CCA_MRPT_PROGRAM MAPS_FOLDER [--keep DIR]   status 77: there is no Chromium, or no cpp-httplib
"""
import os
import shutil
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from live_page_test import Run  # noqa: E402
from replay_page_test import SIZES, Browser, check, failures, place_of  # noqa: E402

STATE = "document.getElementById('state').textContent"


def open_page(browser, run, width=1000, height=800):
    browser.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
    browser.call('Page.navigate', url=f'{run.origin}/{run.query}')
    browser.wait('!!window.player && player.maps.length === 1 && !!player.live.robot')


def test_run_that_goes_on(browser, run, keep):
    robot = lambda: browser.run('[player.live.robot.x, player.live.robot.y]')
    drawn = lambda: browser.run('player.maps[0].robot.getLatLngs()[0].at(-1).lng')
    first, tip = robot(), drawn()
    browser.wait(f'player.live.robot.x !== {first[0]} && player.maps[0].drawn.size > 2')
    browser.wait(f'player.maps[0].robot.getLatLngs()[0].at(-1).lng !== {tip}')
    check(browser.run(STATE) == 'live', f'state {browser.run(STATE)}')

    browser.press('s')
    browser.wait(f"{STATE} === 'paused'")
    time.sleep(1)
    stands = robot()
    time.sleep(1)
    check(robot() == stands, 'a paused robot stands')
    check(browser.run('player.time === player.duration'), 'the last moment is shown')
    browser.settle()
    if keep:
        browser.picture().save(os.path.join(keep, 'live.png'))

    # Back in time, and to the run again.
    browser.press('Home', 36)
    check(browser.run('player.time') == 0 and not browser.run('player.live.isFollowing'), 'Home leaves the run')
    browser.press('l')
    check(browser.run('player.time === player.duration'), 'l follows it again')

    # Layers, measuring.
    browser.press('1')
    check(browser.run("player.hidden.has('lines')"), 'key 1 hides the lines')
    # No ends of lines are there to snap to.
    browser.press('m')
    browser.click(*place_of(browser, *stands)), browser.click(*place_of(browser, stands[0] + 1, stands[1]))
    measured = browser.run("document.getElementById('measured').textContent")
    check(abs(float(measured.split()[0]) - 1) < 0.1, f'a metre measures {measured}')
    browser.press('Escape')
    browser.press('1')

    # There and back by a click.
    x, y = browser.run('(({ x, y }) => [x[0], y[0]])(player.maps[0].run.pose)')  # it has stood there
    browser.press('g')
    browser.click(*place_of(browser, x, y))
    browser.wait(f'Math.hypot(player.live.robot.x - {x}, player.live.robot.y - {y}) < 0.4')
    check(browser.run(STATE) == 'paused', 'it is paused again')


def test_sizes(browser, run, keep):
    least = {'desk': 0.4 * 800, 'phone': 740 / 4, 'phone lying': 0.6 * 360}
    for name, (width, height) in SIZES.items():
        open_page(browser, run, width, height)
        browser.settle()
        if keep:
            browser.picture().save(os.path.join(keep, 'live_' + name.replace(' ', '_') + '.png'))
        page_width, page_height, map_height = browser.run('''[document.documentElement.scrollWidth,
            document.documentElement.scrollHeight, document.querySelector('.map').clientHeight]''')
        check(page_width <= width and page_height <= height, f'{name}: the page is {page_width} x {page_height}')
        check(map_height >= least[name], f'{name}: the map is {map_height} pixels high')
        small = browser.run('''Array.from(document.querySelectorAll('#live button'), (e) => [e.id, e.getBoundingClientRect()])
            .filter(([, b]) => b.width < 44 || b.height < 44).map(([n]) => n)''')
        check(not small, f'{name}: smaller than a finger: {small}')


def test_lost_connection(browser, program, world, folder, run):
    """A server that dies is told of; one that comes back at the same port is followed."""
    run.process.kill()
    run.process.wait()
    browser.wait(f"{STATE}.startsWith('connection lost')")
    check(browser.run("document.getElementById('pause').disabled"), 'nothing can be asked for')
    again = Run(program, 'explore', world, '--quiet', '--serve', str(run.port), '--out', folder + '/again')
    again.command(do='pause')
    browser.wait(f"{STATE} === 'paused'")
    again.command(do='start')
    browser.wait(f"{STATE}.startsWith('ended')")
    again.process.wait()
    check(browser.run('player.maps[0].drawn.size') > 5, 'the map stays')


def main():
    program, maps = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    keep = os.path.abspath(sys.argv[4]) if sys.argv[3:4] == ['--keep'] else None
    chromium = shutil.which('chromium') or shutil.which('google-chrome')
    if not chromium:
        print('SKIPPED: there is no Chromium')
        return 77
    with tempfile.TemporaryDirectory() as folder:
        world = maps + '/office.yaml'
        run = Run(program, 'explore', world, '--quiet', '--serve', '0', '--out', folder + '/run')
        browser = Browser(chromium, folder + '/profile')
        try:
            open_page(browser, run)
            test_run_that_goes_on(browser, run, keep)
            test_sizes(browser, run, keep)
            check(not browser.errors, f'errors: {browser.errors}')
            test_lost_connection(browser, program, maps + '/two_rooms.yaml', folder, run)
        finally:
            browser.close()
            run.process.kill()
    print('live page:', 'FAILED' if failures else 'passed')
    return bool(failures)


if __name__ == '__main__':
    sys.exit(main())
