# SPDX-License-Identifier: BSD-3-Clause
"""Who looks at a live page, by its requests."""
import http.client
import json
import time

PATIENCE = 20  # s, for a busy machine


class Viewer:
    """@param query  of the page's address: its token, or nothing."""

    def __init__(self, address, port, query=''):
        self.address, self.port, self.query = address, port, query
        self.origin = f'http://{address}:{port}'

    def ask(self, method, path, body=None, **headers):
        """Status and text of an answer; 0 where the connection was cut."""
        connection = http.client.HTTPConnection(self.address, self.port, timeout=PATIENCE)
        host = headers.pop('Host', f'{self.address}:{self.port}')
        try:
            connection.request(method, path, body, {'Host': host, **headers})
            answer = connection.getresponse()
            return answer.status, answer.read().decode()
        except (OSError, http.client.HTTPException):
            return 0, ''
        finally:
            connection.close()

    def command(self, **body):
        return self.ask('POST', '/command' + self.query, json.dumps(body), Origin=self.origin)[0]

    def events(self):
        """What a viewer is told, one event after the other, until the run ends; {} once a second of silence."""
        begin = time.time()
        while True:
            connection = http.client.HTTPConnection(self.address, self.port, timeout=PATIENCE)
            connection.request('GET', '/events' + self.query, headers={'Host': f'{self.address}:{self.port}'})
            answer = connection.getresponse()
            if answer.status == 200:
                break
            connection.close()
            # Viewers who have gone are missed within seconds.
            if answer.status != 503 or time.time() - begin > PATIENCE:
                raise RuntimeError(f'events: {answer.status}')
            time.sleep(0.2)
        try:
            for line in answer:
                if line.startswith(b'data: '):
                    yield json.loads(line[6:])
                elif line.startswith(b':'):
                    yield {}
        finally:
            connection.close()

    def where(self):
        told = next(e for e in self.events() if 'robot' in e)
        return told['robot']['x'], told['robot']['y'], told['paused']
