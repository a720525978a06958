"""A fleet on any executor: concurrent.futures, dask.distributed, joblib, Ray.

    from concurrent.futures import ThreadPoolExecutor
    with ThreadPoolExecutor(8) as pool:
        fleet("fleet.csv", "rows", "fleet", pool.map, shards=64)

    client = dask.distributed.Client()
    fleet("fleet.csv", "rows", "fleet", lambda f, *a: client.gather(client.map(f, *a, pure=False)), shards=64)

A shard that dies with its worker is asked again; the rows it had written are kept, so nothing is done twice.
"""

import subprocess
import sys


def shard(manifest, rows, part, program="creepage"):
    """Asks `discover` of the robots of a shard, such as "3/64"."""
    subprocess.run([program, "fleet", "map", manifest, "--out", rows, "--shard", part, "--threads", "1", "--quiet"], check=True)
    return part


def fleet(manifest, rows, out, map=map, shards=16, program="creepage"):
    """Maps the shards of a fleet with `map`, and joins their rows."""
    parts = [f"{i}/{shards}" for i in range(1, shards + 1)]
    done = list(map(shard, [manifest] * shards, [rows] * shards, parts, [program] * shards))
    assert done == parts
    subprocess.run([program, "fleet", "join", rows, "--out", out, "--quiet"], check=True)


if __name__ == "__main__":
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor() as pool:
        fleet(*sys.argv[1:4], pool.map, shards=8)
