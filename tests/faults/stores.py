"""Stores to be damaged: edits of their tables, and of their bytes, drawn by a seed."""

import json
import random
import sqlite3
from pathlib import Path

MEMBERS = 16


def members_of(store: Path) -> list[tuple[object, ...]]:
    """The rows of a store; none if it has no such table yet."""
    database = sqlite3.connect(store)
    try:
        return database.execute("SELECT * FROM members ORDER BY member").fetchall()
    except sqlite3.Error:
        return []
    finally:
        database.close()


def edit(store: Path, draw: random.Random) -> str:
    """One or two edits of its tables, as another program makes them; what was done, in words."""
    database = sqlite3.connect(store, isolation_level=None)
    done = []
    try:
        for _ in range(draw.choice((1, 1, 2))):
            statement, values = _statement(database, draw)
            try:
                database.execute(statement, values)
            except sqlite3.Error as error:
                statement = f"{statement}: {error}"
            done.append(f"{statement} {values}")
        database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    finally:
        database.close()
    return "; ".join(done)


def _statement(database: sqlite3.Connection, draw: random.Random) -> tuple[str, tuple[object, ...]]:
    tables = [row[0] for row in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
    if not tables:
        return "CREATE TABLE members (member)", ()
    table = draw.choice(tables)
    columns = [row[1] for row in database.execute(f"PRAGMA table_info({table})")]
    column = draw.choice(columns)
    rows = [row[0] for row in database.execute(f"SELECT rowid FROM {table}")] or [0]
    value = draw.choice((None, 0, -1, 1.5, 1e308, 9e999, 2**62, "", "x", "null", "[]", "{", '"a"', b"\xff\x00", "7"))
    row = draw.choice(rows)
    kind = draw.choice(
        ("value", "value", "value", "value", "delete", "insert", "drop", "rename", "add", "gone", "json")
    )
    if kind == "json":  # still JSON, of another meaning
        text = database.execute("SELECT value FROM study ORDER BY random() LIMIT 1").fetchone()
        changed = "" if text is None else str(text[0]).replace("1", "2").replace("0", "3")
        return "UPDATE study SET value = ? WHERE value = ?", (changed, text and text[0])
    return {
        "value": (f'UPDATE {table} SET "{column}" = ? WHERE rowid = ?', (value, row)),
        "delete": (f"DELETE FROM {table} WHERE rowid = ?", (row,)),
        "insert": (f'INSERT INTO {table} ("{column}") VALUES (?)', (value,)),
        "drop": (f"DROP TABLE {table}", ()),
        "rename": (f'ALTER TABLE {table} RENAME COLUMN "{column}" TO "other"', ()),
        "add": (f"ALTER TABLE {table} ADD COLUMN more", ()),
        "gone": (f'ALTER TABLE {table} DROP COLUMN "{column}"', ()),
    }[kind]


def corrupt(store: Path, draw: random.Random) -> str:
    """Bytes of the file changed, cut off, or put elsewhere, as disks and copies do; what was done, in words."""
    content = bytearray(store.read_bytes())
    place, length = draw.randrange(len(content)), draw.choice((1, 1, 2, 8, 64, 512, 4096))
    kind = draw.choice(("flip", "flip", "flip", "zeros", "noise", "cut", "twice", "text", "empty"))
    if kind == "flip":
        content[place] ^= 1 << draw.randrange(8)
    elif kind == "zeros":
        content[place : place + length] = bytes(len(content[place : place + length]))
    elif kind == "noise":
        content[place : place + length] = draw.randbytes(len(content[place : place + length]))
    elif kind == "cut":
        del content[place:]
    elif kind == "twice":
        content[place:place] = content[place : place + length]
    elif kind == "text":
        content[:] = json.dumps({"members": []}).encode() * draw.randrange(1, 100)
    else:
        content.clear()
    store.write_bytes(content)
    return f"{kind} at {place}, {length}"
