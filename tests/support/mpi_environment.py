"""The environment for mpirun, as jobs/mpi_environment.sh has it."""
import pathlib
import subprocess

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "jobs/mpi_environment.sh"
_said = subprocess.run(["sh", "-c", f". '{SCRIPT}'; env -0"], stdout=subprocess.PIPE, check=True).stdout.decode()
ENVIRONMENT = dict(entry.split("=", 1) for entry in _said.split("\0")[:-1])
# More ranks than cores are welcome, and not bound to any, where a command has no options for that (Open MPI 4.1, 5).
CROWDED = {**ENVIRONMENT, "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
           "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "PRTE_MCA_hwloc_default_binding_policy": "none"}
