# Sourced before mpirun, by jobs and tests alike: what Open MPI 4.1 and 5 want to hear on a machine of one's own.

# As root (containers) they ask to be told so twice.
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
# Ranks of one machine share memory. Both would first look for a network: 4.1 takes a third longer to start, and 5
# complains where there is none. Containers forbid one process to read another's memory: both would complain of that,
# and then do without anyway.
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_smsc=^cma
# No banner where the program ends with a code other than 0. (5 has no such setting, and knows 4.1's option -q no more.)
export OMPI_MCA_orte_execute_quiet=1
