# Sourced by the scripts: where they stand, and what Open MPI, BLAS and Scotch are to do on any machine, as root too.
cd "$(dirname "$0")/.."
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe # the same for Open MPI 5
export OMP_NUM_THREADS=1 SCOTCH_PTHREAD_NUMBER=1
