# Sourced before mpirun, by jobs and tests alike: what Open MPI wants to hear on a machine of one's own.

# As root (containers) it asks to be told so twice.
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
# Containers forbid one process to read another's memory; it would warn of that, and then do without anyway.
export OMPI_MCA_btl_vader_single_copy_mechanism=none
