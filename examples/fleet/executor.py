"""A fleet on any executor, by the package for Python (`pip install ./python`).

    python executor.py fleet.csv fleet

Here on threads. On a cluster of Dask:

    with dask.distributed.Client("tcp://scheduler:8786") as client:
        cp.fleet("fleet.csv", "fleet", executor=client, shards=64)
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import creepage as cp

if __name__ == "__main__":
    manifest, out = sys.argv[1:3]
    with ThreadPoolExecutor() as pool:
        cp.fleet(manifest, out, executor=pool, shards=8)
