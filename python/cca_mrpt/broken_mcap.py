# SPDX-License-Identifier: BSD-3-Clause
"""MCAP files whose end is missing: a recorder was killed, or the disk was full. What stands there is read in order."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, Iterator, List, NamedTuple, Sequence, Tuple


class Connection(NamedTuple):
    id: int
    topic: str
    msgtype: str
    msgcount: int


class BrokenMcap:
    """What `rosbags` would tell of the file. Each call of `messages` reads it anew, up to where it breaks off.

    Raises:
        ValueError: nothing in it can be read.
    """

    def __init__(self, path: Path) -> None:
        from mcap.records import Channel, Message, Schema
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        self._path = path
        self._store: Any = get_typestore(Stores.ROS2_HUMBLE)
        schemas: Dict[int, str] = {}
        channels: Dict[int, Tuple[str, str]] = {}
        counts: Dict[int, int] = {}
        for record in self._records():
            if isinstance(record, Schema) and record.id:
                name = record.name if "/msg/" in record.name else record.name.replace("/", "/msg/", 1)
                schemas[record.id] = name
                if record.encoding == "ros2msg":
                    types = get_types_from_msg(record.data.decode(), name)
                    self._store.register({key: value for key, value in types.items() if key not in self._store.fielddefs})
            elif isinstance(record, Channel):
                channels[record.id] = (record.topic, schemas.get(record.schema_id, ""))
            elif isinstance(record, Message):
                counts[record.channel_id] = counts.get(record.channel_id, 0) + 1
        if not channels:
            raise ValueError(f"{path}: is a damaged .mcap file: nothing in it can be read")
        self.connections: List[Connection] = [Connection(key, *channels[key], counts.get(key, 0)) for key in channels]

    def _records(self) -> Iterator[Any]:
        from mcap.stream_reader import StreamReader

        with self._path.open("rb") as file:
            try:
                yield from StreamReader(file, skip_magic=False).records
            except Exception:  # mcap's, struct's and those of what unpacks chunks: here it breaks off
                return

    def messages(self, connections: Sequence[Connection]) -> Iterator[Tuple[Connection, int, bytes]]:
        from mcap.records import Message

        wanted = {connection.id: connection for connection in connections}
        for record in self._records():
            if isinstance(record, Message) and record.channel_id in wanted:
                yield wanted[record.channel_id], record.log_time, record.data

    def deserialize(self, raw: bytes, msgtype: str) -> Any:
        return self._store.deserialize_cdr(raw, msgtype)
