#!/bin/sh
# An erosion study as a job array of Slurm, one shard per task:
#
#   STUDY=studies/sphere_vs_angular.ron OUT=/shared/results sbatch --array=0-7 studies/slurm.sh
#   abrade sweep "$STUDY" --out "$OUT" --merge
#
# Shards count from 0: an array of N tasks is --array=0-<N - 1>, in one piece.
#
# A task that is killed loses the last seconds of the case that it was at and nothing else: submit the
# array again, and it makes what is missing. `abrade` must be in the PATH of the nodes, or ABRADE say where it is.
#SBATCH --job-name=abrade
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -eu
: "${STUDY:?the study file}" "${OUT:?a folder that all nodes see}"
[ "${SLURM_ARRAY_TASK_MIN:-0}" = 0 ] && [ "$SLURM_ARRAY_TASK_MAX" -lt "$SLURM_ARRAY_TASK_COUNT" ] || {
  echo "submit the whole array, --array=0-<N - 1>: shards count from 0" >&2
  exit 2
}
exec "${ABRADE:-abrade}" sweep "$STUDY" --out "$OUT" --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
