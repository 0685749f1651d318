# What `submit` needs to know of a cluster: copy, change, and give it as SITE=path. Empty: as the cluster has it.
partition=
account=
time=12:00:00       # of one part; a part that runs out of it goes on when submitted again
memory_mb=2000      # of a part, which has one core; peak_memory_mb of press.timings.yaml says what a sample took
throttle=500        # parts that run at a time
options=            # further words for sbatch, such as --constraint=avx2: equal bytes need equal processors (docs/files.md)
setup=              # commands before the work, such as 'module load apptainer'
run=                # what make is run in, such as 'apptainer exec --bind /scratch tacipc.sif'
