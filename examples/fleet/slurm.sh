#!/bin/sh
# A fleet as a Slurm array: sbatch --array=1-64 examples/fleet/slurm.sh FLEET.csv ROWS
# and when all are done: creepage fleet join ROWS --out fleet
#SBATCH --cpus-per-task=1
#SBATCH --time=1:00:00
exec creepage fleet map "$1" --out "$2" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads 1
