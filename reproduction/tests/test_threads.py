"""Work on all cores that is interrupted gives up what is not begun."""

from threading import Event, Timer

import pytest

from cointoss_reproduction.frame.threads import all_cores


def test_what_is_not_begun_is_given_up():
    begun, go = [], Event()

    def work(number):
        begun.append(number)
        go.wait()
        return number

    def interrupted():
        with all_cores() as pool:
            pool.map(work, range(1000))
            # What has begun goes on only when the rest is given up.
            Timer(2.0, go.set).start()
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert 0 < len(begun) < 1000
