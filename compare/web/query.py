"""The query of a request, read strictly: known names, each once, and numbers of a form."""

import re
from collections.abc import Sequence
from urllib.parse import parse_qsl

NUMBER = re.compile(r"[+-]?([0-9]{1,40}(\.[0-9]{0,40})?|\.[0-9]{1,40})([eE][+-]?[0-9]{1,3})?", re.ASCII)
COUNT = re.compile(r"[0-9]{1,12}", re.ASCII)

Query = dict[str, str]


class QueryError(ValueError):
    """A query that can't be answered; the message says what is accepted."""


def query_of(text: str, *names: str, also: str = "") -> Query:
    """Return what a query says, which has each of these names once, and perhaps one more.

    Raises:
        QueryError: for another one.
    """
    try:
        pairs = parse_qsl(text, keep_blank_values=True, strict_parsing=bool(text), max_num_fields=8)
    except ValueError:
        raise QueryError("accepted: NAME=VALUE&NAME=VALUE") from None
    query = dict(pairs)
    if len(query) < len(pairs):
        raise QueryError("accepted: each name once")
    if not set(names) <= set(query) <= {*names, also}:
        raise QueryError(f"accepted: {', '.join(names) or 'no query'}")
    return query


def texts_in(query: Query, names: Sequence[str], form: re.Pattern[str], accepted: str) -> list[str]:
    """Return the values of some names, which are of a form.

    Raises:
        QueryError: naming the first that is not, and what is accepted.
    """
    for name in names:
        if not form.fullmatch(query[name]):
            raise QueryError(f"{name}: accepted: {accepted}")
    return [query[name] for name in names]
