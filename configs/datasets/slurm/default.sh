# Settings of a cluster for `submit`: copy, change, and pass it as SITE=path. Empty: the cluster's default.
# shellcheck shell=bash disable=SC2034
partition=
account=
time=12:00:00       # of one part; a part that runs out of it resumes when submitted again
memory_mb=2000      # of a part, which has one core; peak_memory_mb of press.timings.yaml is that of a sample
throttle=500        # parts that run at a time
options=            # further words for sbatch, such as --constraint=avx2: equal bytes need equal processors (docs/files.md)
setup=              # commands before the work, such as 'module load apptainer'
run=                # wrapper of make, such as 'apptainer exec --bind /scratch tacipc.sif'
