"""Requests that wait for each other, and that end where their client has gone meanwhile."""

import select
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

PAUSE = 0.05
"""How often a request that waits looks for its client, and how long a client's system has to answer [s]."""


class Client:
    """The other end of a connection."""

    def __init__(self, connection: socket.socket, start: bytes) -> None:
        """Take it to be there.

        Args:
            connection: to it.
            start: bytes with which every answer begins.
        """
        self._connection, self._start, self._sent = connection, start, b""

    @property
    def has_gone(self) -> bool:
        """Whether the client has hung up; one that only sends no more has not.

        The two differ once something is sent to it: the system of one that has gone refuses it.
        """
        try:
            if not self._sent:
                if not select.select([self._connection], [], [], 0)[0]:
                    return False
                if self._connection.recv(1, socket.MSG_PEEK):
                    return False
                self._connection.sendall(self._start)
                self._sent = self._start
                time.sleep(PAUSE)
            return self._connection.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR) != 0
        except OSError:
            return True

    def require_there(self) -> None:
        """Give up what is made for a client that has gone.

        Raises:
            ConnectionAbortedError: where it has.
        """
        if self.has_gone:
            raise ConnectionAbortedError("the client has hung up")

    def left_of(self, answer: bytes) -> bytes:
        """Return what of an answer was not sent yet."""
        return answer.removeprefix(self._sent)


@contextmanager
def in_turn(turn: threading.Lock, client: Client) -> Iterator[None]:
    """Wait for a turn, and keep it.

    Raises:
        ConnectionAbortedError: where the client has gone before.
    """
    while not turn.acquire(timeout=PAUSE):
        client.require_there()
    try:
        client.require_there()
        yield
    finally:
        turn.release()
