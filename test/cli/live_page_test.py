#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The live page, by its requests: what a viewer is told, what commands do, and what hostile clients cannot.

live_page_test.py CCA_MRPT_PROGRAM MAPS_FOLDER   exit status 77: the program was built without cpp-httplib
"""
import filecmp
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

from live_viewer import PATIENCE, Viewer

RESULTS = 'lines.csv', 'arcs.csv', 'poses.csv', 'run.rawlog', 'replay.html', 'map.pgm'

failures = []


def check(holds, what):
    if not holds:
        failures.append(what)
        print('FAILED:', what)


class Run(Viewer):
    """A program that serves its run."""

    def __init__(self, program, *words):
        self.process = subprocess.Popen([program, *words], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        self.said = ''
        while True:
            line = self.process.stderr.readline()
            self.said += line
            found = re.search(r'seen at http://([0-9.]+):(\d+)/(\S*)', line)
            if found:
                break
            if not line:
                if 'cpp-httplib' in self.said:
                    print('skipped:', self.said)
                    sys.exit(77)
                raise RuntimeError('nothing is served: ' + self.said)
        super().__init__(found[1], int(found[2]), found[3])

    def wait_for(self, wanted, what):
        begin = time.time()
        for event in self.events():
            if event and wanted(event):
                return event
            if time.time() - begin > PATIENCE:
                break
        check(False, 'in vain: ' + what)
        return None

    def stop(self, number=signal.SIGINT):
        self.process.send_signal(number)
        self.said += self.process.stderr.read()
        return self.process.wait(PATIENCE)


def stands_still(run, seconds=1.5):
    first = run.where()
    time.sleep(seconds)
    return first[:2] == run.where()[:2]


def test_same_results(program, world, folder):
    """A run that is looked at brings home the same bytes."""
    alone, seen = os.path.join(folder, 'alone'), os.path.join(folder, 'seen')
    subprocess.run([program, 'explore', world, '--quiet', '--out', alone], check=True)
    run = Run(program, 'explore', world, '--quiet', '--serve', '0', '--out', seen)
    told = [event for event in run.events() if event]
    check(run.process.wait(PATIENCE) == 0, f'the run ends well: {run.said}')
    check('whole' in told[0] or 'whole' in told[1], 'a viewer has the whole first')
    check(told[-1]['end'] != '', 'the last event tells the end')
    check(any('more' in e for e in told), f'{len(told)} events, none of which adds to the whole')
    for name in RESULTS:
        check(filecmp.cmp(os.path.join(alone, name), os.path.join(seen, name), shallow=False), f'{name} is the same')
    log = os.path.join(alone, 'run.rawlog')
    for pose in 'slam', 'odometry':
        first, second = os.path.join(folder, pose + '1'), os.path.join(folder, pose + '2')
        subprocess.run([program, 'map', log, '--quiet', '--pose', pose, '--out', first], check=True)
        subprocess.run([program, 'map', log, '--quiet', '--pose', pose, '--out', second, '--serve', '0'], check=True,
                       stderr=subprocess.DEVNULL)
        for name in 'lines.csv', 'poses.csv', 'replay.html':
            check(filecmp.cmp(os.path.join(first, name), os.path.join(second, name), shallow=False),
                  f'map --pose {pose}: {name} is the same')


def test_commands(program, world, folder):
    out = os.path.join(folder, 'commanded')
    run = Run(program, 'explore', world, '--quiet', '--serve', '0', '--out', out)
    check(run.command(do='pause') == 204, 'pause is heard')
    run.wait_for(lambda e: e['paused'], 'the run pauses')
    time.sleep(1)
    check(stands_still(run), 'the robot stands while paused')
    x, y, _ = run.where()
    check(run.command(do='go', x=x + 0.5, y=y) == 204, 'go is heard')
    run.wait_for(lambda e: abs(e['robot']['x'] - x - 0.5) < 0.3 and abs(e['robot']['y'] - y) < 0.3, 'it goes there')
    time.sleep(1)
    check(stands_still(run), 'it is paused again where it was sent')
    for wrong in ({}, {'do': 'dance'}, {'do': 'go'}, {'do': 'go', 'x': 'a', 'y': 1}, {'do': 'go', 'x': 1e300, 'y': 0}):
        check(run.command(**wrong) == 400, f'{wrong} is no command')
    check(run.command(do='start') == 204, 'start is heard')
    before = run.where()[:2]
    run.wait_for(lambda e: not e['paused'] and (e['robot']['x'], e['robot']['y']) != before, 'it drives on')
    check(run.command(do='home') == 204, 'home is heard')
    end = run.wait_for(lambda e: e['end'], 'it ends at home')
    check(run.process.wait(PATIENCE) in (0, 1, 3), 'ends')
    check(end and os.path.exists(os.path.join(out, 'summary.json')), 'what was mapped is saved')


def test_interruption(program, world, folder):
    """Ctrl-C saves what was mapped, while somebody looks and the robot stands."""
    out = os.path.join(folder, 'interrupted')
    run = Run(program, 'explore', world, '--quiet', '--serve', '0', '--out', out)
    events = run.events()
    next(events)
    run.command(do='pause')
    run.wait_for(lambda e: e['paused'], 'the run pauses')
    begin = time.time()
    run.stop()
    check(time.time() - begin < 15, f'ends {time.time() - begin:.1f} s after Ctrl-C')
    check(any(e.get('end') == 'interrupted' for e in events), 'viewers are told')
    check(os.path.exists(os.path.join(out, 'summary.json')), 'what was mapped is saved')


def test_port_in_use(program, world, folder):
    with socket.create_server(('127.0.0.1', 0)) as taken:
        port = taken.getsockname()[1]
        run = subprocess.run([program, 'explore', world, '--serve', str(port), '--out', os.path.join(folder, 'none')],
                             capture_output=True, text=True)
    check(run.returncode != 0 and f'127.0.0.1:{port}' in run.stderr, f'a port in use: {run.stderr}')
    check(not os.path.exists(os.path.join(folder, 'none')), 'and no folder is left')


def test_hostile_clients(program, world, folder):
    out = os.path.join(folder, 'besieged')
    run = Run(program, 'explore', world, '--quiet', '--serve', '0', '--out', out)
    run.command(do='pause')
    run.wait_for(lambda e: e['paused'], 'the run pauses')
    time.sleep(1)
    place = run.where()
    go = json.dumps({'do': 'go', 'x': place[0] + 1, 'y': place[1]})
    home = json.dumps({'do': 'home'})

    # Pages of other origins, and names that others have pointed here.
    for body in go, home, json.dumps({'do': 'start'}):
        for headers in ({}, {'Origin': 'http://evil.example'}, {'Origin': 'null'},
                        {'Origin': run.origin, 'Host': f'evil.example:{run.port}'},
                        {'Origin': f'http://evil.example:{run.port}', 'Host': f'evil.example:{run.port}'},
                        {'Origin': f'http://127.0.0.1:{run.port + 1}'}):
            check(run.ask('POST', '/command', body, **headers)[0] == 403, f'{headers} may not command')
    for path in '/', '/events':
        check(run.ask('GET', path, Host='evil.example')[0] == 403, f'{path} of another host')
        check(run.ask('GET', path, Origin='http://evil.example')[0] == 403, f'{path} for another origin')
    check(run.ask('GET', '/command')[0] == 404, 'a command is posted')
    check(run.ask('GET', '/../../etc/passwd')[0] in (400, 404), 'there are no files')
    check(run.ask('PUT', '/command', go, Origin=run.origin)[0] != 204, 'a command is posted')

    # Large and broken requests.
    large = json.dumps({'do': 'go', 'x': 1, 'y': 1, 'z': 'a' * 10_000_000})
    check(run.ask('POST', '/command', large, Origin=run.origin)[0] in (0, 413), '10 MB are refused')
    for text in (b'\0' * 5000, b'GET /' + b'a' * 100_000, b'POST /command HTTP/1.1\r\nContent-Length: -1\r\n\r\n',
                 b'POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n'):
        with socket.create_connection(('127.0.0.1', run.port), PATIENCE) as client:
            try:
                client.sendall(text)
                client.shutdown(socket.SHUT_WR)
                client.recv(1000)
            except OSError:
                pass
    check(run.ask('POST', '/command', '[' * 4000, Origin=run.origin)[0] == 400, 'deep nesting')

    # Too many viewers, who do not even read.
    viewers = []
    for _ in range(60):
        client = socket.create_connection(('127.0.0.1', run.port), PATIENCE)
        client.sendall(f'GET /events HTTP/1.1\r\nHost: 127.0.0.1:{run.port}\r\n\r\n'.encode())
        viewers.append(client)
    heads = []
    for client in viewers:
        client.settimeout(PATIENCE)
        heads.append(client.recv(12).decode())
    check(heads.count('HTTP/1.1 200') == 32, f'32 viewers: {heads.count("HTTP/1.1 200")}')
    check(heads.count('HTTP/1.1 503') == 28, f'28 refused: {heads.count("HTTP/1.1 503")}')
    check(run.ask('GET', '/')[0] == 200, 'the page is served beside them')

    # A thousand connections that say nothing.
    crowd = []
    for _ in range(1000):
        client = socket.socket()
        client.setblocking(False)
        client.connect_ex(('127.0.0.1', run.port))
        crowd.append(client)
    time.sleep(1)
    files = len(os.listdir(f'/proc/{run.process.pid}/fd'))
    check(files < 250, f'{files} files are open')
    for client in crowd + viewers:
        client.close()

    # After all that: nothing has moved, and the page is there.
    run.where()
    check(run.ask('GET', '/')[0] == 200, 'the page is served again')
    check(run.where() == place, f'nothing has moved the robot: {place}, {run.where()}')
    check(run.command(do='start') == 204, 'who may command is heard')
    list(run.events())
    run.process.wait(PATIENCE)
    with open(os.path.join(out, 'summary.json'), encoding='utf-8') as file:
        summary = json.load(file)
    check(summary['finished'] and summary['collisions'] == 0, f"the run ends as others do: {summary['reason']}")
    check(all(os.path.exists(os.path.join(out, name)) for name in RESULTS), 'nothing is lost')


def test_token(program, world, folder):
    """At another address than this machine's own, nobody looks or commands without the token."""
    run = Run(program, 'explore', world, '--quiet', '--serve', '0', '--serve-address', '0.0.0.0', '--out',
              os.path.join(folder, 'open'))
    check(re.fullmatch(r'\?token=[0-9a-f]{32}', run.query), f'a token is told: {run.query}')
    body = json.dumps({'do': 'pause'})
    for query in '', '?token=', '?token=' + 32 * '0', run.query[:-1], run.query + '0':
        for method, path in ('GET', '/'), ('GET', '/events'), ('POST', '/command'):
            status = run.ask(method, path + query, body if method == 'POST' else None, Origin=run.origin)[0]
            check(status == 403, f'{method} {path}{query}: {status}')
    check(not run.where()[2], 'and nothing has paused it')
    check(run.command(do='pause') == 204, 'with the token it is heard')
    run.wait_for(lambda e: e['paused'], 'the run pauses')
    run.stop()


def main():
    program, maps = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    world = os.path.join(maps, 'two_rooms.yaml')
    with tempfile.TemporaryDirectory() as folder:
        for test in (test_same_results, test_commands, test_interruption, test_port_in_use, test_hostile_clients,
                     test_token):
            begin = time.time()
            test(program, world, folder)
            print(f'{test.__name__}: {time.time() - begin:.1f} s')
    print('failed' if failures else 'passed')
    sys.exit(bool(failures))


if __name__ == '__main__':
    main()
