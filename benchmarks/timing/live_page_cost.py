#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a live page costs the run, and how far it lags behind.

live_page_cost.py CCA_MRPT_PROGRAM WORLD [ROUNDS]

Runs explore in turns without --serve, with it, with one viewer, and with 32 of whom half do not read; tells the wall
time of each over that of the first, what more of processor time (of all its threads) that is a scan, and how long after
the moment was shown a viewer has read it.
"""
import json
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'test', 'cli'))
from live_page_test import Run


def read(run, lags):
    try:
        for event in run.events():
            if event.get('shown_at') and not event['end'] and not event['paused']:
                lags.append(time.time() - event['shown_at'])
    except (OSError, RuntimeError):
        pass


def measure(program, world, out, viewers):
    """Wall time [s] by the run's own clock, processor time [s], scans, and lags [s] of the first viewer."""
    words = 'explore', world, '--quiet', '--force', '--out', out
    lags, deaf = [], []
    if viewers is None:
        process = subprocess.Popen([program, *words])
    else:
        run = Run(program, *words, '--serve', '0')
        for number in range(viewers):
            if number % 2 == 1:
                client = socket.create_connection(('127.0.0.1', run.port))
                client.sendall(f'GET /events HTTP/1.1\r\nHost: 127.0.0.1:{run.port}\r\n\r\n'.encode())
                deaf.append(client)
            else:
                lags_of = lags if number == 0 else []
                threading.Thread(target=read, args=(run, lags_of), daemon=True).start()
        run.process.stderr.read()
        process = run.process
    usage = os.wait4(process.pid, 0)[2]
    with open(os.path.join(out, 'summary.json'), encoding='utf-8') as file:
        summary = json.load(file)
    return summary['wall_s'], usage.ru_utime + usage.ru_stime, summary['scans'], lags


def main():
    program, world, rounds = sys.argv[1], sys.argv[2], int((sys.argv[3:] or ['3'])[0])
    names = {None: 'without --serve', 0: 'nobody looks', 1: 'one viewer', 32: '32 viewers, half of them deaf'}
    walls, spent, lags = {v: [] for v in names}, {v: [] for v in names}, []
    with tempfile.TemporaryDirectory() as out:
        for _ in range(rounds):
            for viewers in names:
                wall, processor, scans, seen = measure(program, world, out, viewers)
                walls[viewers].append(wall)
                spent[viewers].append(processor)
                print(f'{names[viewers]}: {wall:.2f} s, of processors {processor:.2f} s', flush=True)
                if viewers == 1:
                    lags += seen
    alone, own = statistics.median(walls[None]), statistics.median(spent[None])
    for viewers, name in names.items():
        wall, processor = statistics.median(walls[viewers]), statistics.median(spent[viewers])
        print(f'{name}: {wall / alone:.3f} x, {1e3 * (processor - own) / scans:+.3f} ms a scan ({scans} scans)')
    lags.sort()
    print(f'lag: median {1e3 * statistics.median(lags):.0f} ms, 99 % {1e3 * lags[int(0.99 * len(lags))]:.0f} ms, '
          f'worst {1e3 * lags[-1]:.0f} ms of {len(lags)} events')


if __name__ == '__main__':
    main()
