"""A fleet on engines of several kinds: the same bytes, and nothing lost with a worker."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from conftest import ROOT

import creepage as cp
from creepage.fleet import shard

MANIFEST = ROOT / "examples" / "fleet" / "fleet.csv"


class Mapping:
    """An engine that has `map` alone."""

    def map(self, function, *columns):
        return map(function, *columns)


class Dying:
    """An engine whose first workers are killed."""

    def __init__(self, pool: ThreadPoolExecutor) -> None:
        self.pool, self.killed = pool, 0

    def submit(self, function, *arguments):
        self.killed += 1
        if self.killed > 2:
            return self.pool.submit(function, *arguments)

        def die() -> None:
            raise OSError("the worker was killed")

        return self.pool.submit(die)


def test_every_engine_gives_the_same_bytes(tmp_path) -> None:
    with ThreadPoolExecutor(2) as pool:
        engines = {"own": (None, 2), "map": (Mapping(), 1), "dying": (Dying(pool), 3)}
        for name, (executor, shards) in engines.items():
            answer = cp.fleet(MANIFEST, tmp_path / name, executor=executor, shards=shards)
            assert answer
    files = {path.name for path in (tmp_path / "own").iterdir() if path.is_file()}
    assert {"fleet.json", "fleet.html"} <= files
    for file in files:
        first = (tmp_path / "own" / file).read_bytes()
        assert all((tmp_path / name / file).read_bytes() == first for name in ("map", "dying")), file


def test_a_manifest_that_is_none_is_told(tmp_path) -> None:
    with pytest.raises(cp.InputError, match="nowhere.csv"):
        cp.fleet(tmp_path / "nowhere.csv", tmp_path / "out", shards=1)
    assert shard(str(MANIFEST), str(tmp_path / "rows"), "1/8") == "1/8"


def test_a_sweep_has_the_same_bytes_on_every_engine(tmp_path) -> None:
    spec = ROOT / "examples" / "sweeps" / "wheels.toml"
    whole = cp.sweep(spec, tmp_path / "whole.csv")
    with ThreadPoolExecutor(2) as pool:
        for name, executor in (("pool", pool), ("map", Mapping()), ("dying", Dying(pool))):
            assert cp.sweep(spec, tmp_path / f"{name}.csv", executor=executor, shards=3) == whole
            assert (tmp_path / f"{name}.csv").read_bytes() == (tmp_path / "whole.csv").read_bytes(), name
    assert sorted(p.name for p in tmp_path.iterdir()) == ["dying.csv", "map.csv", "pool.csv", "whole.csv"]
    with pytest.raises(cp.InputError, match="none.toml"):
        cp.sweep(tmp_path / "none.toml", tmp_path / "none.csv", executor=Mapping(), shards=2)
