"""Spack recipe: the program and its Python package, from the clone that this file lies in.

    spack repo add jobs/spack
    spack dev-build --source-path . rubatlas@1.0.0

Spack could not be run where this was written: that it finds the packages, builds and installs has not been tried. A
test executes the recipe with stand-ins for the names of Spack, and compares its version and dependencies with those of
the CMake files and of the Python package.
"""
from spack.package import *

try:
    from spack_repo.builtin.build_systems.cmake import CMakePackage  # from Spack 1 on; before, spack.package has it
except ImportError:
    pass


class Rubatlas(CMakePackage):
    """Parameter-space atlas of a rotor with rubbing blades."""

    license("MIT")
    version("1.0.0")

    variant("tools", default=True, description="Install the Python package that queries and draws atlases")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("hdf5+mpi+hl")
    depends_on("zlib-api")
    depends_on("eigen@3.4:")
    depends_on("nlohmann-json@3.11:")
    depends_on("cli11@2.1:")
    depends_on("fmt@9:")
    depends_on("boost@1.74:")
    depends_on("fftw@3:")

    extends("python@3.11:", when="+tools")
    with when("+tools"):
        depends_on("py-pip", type="build")
        depends_on("py-setuptools@61:", type="build")
        depends_on("py-numpy@1.24:", type=("build", "run"))
        depends_on("py-matplotlib@3.6:", type=("build", "run"))
        depends_on("py-xarray", type=("build", "run"))
        depends_on("py-h5py@3.7:", type=("build", "run"))

    def cmake_args(self):
        return [self.define("RUBATLAS_TESTS", False)]

    def install(self, spec, prefix):
        mkdirp(prefix.bin)
        with working_dir(self.build_directory):
            install("rubatlas", prefix.bin)
        if spec.satisfies("+tools"):
            with working_dir(join_path(self.stage.source_path, "tools")):
                alone = ("--no-deps", "--no-build-isolation", "--no-index")
                python("-m", "pip", "install", *alone, f"--prefix={prefix}", ".")
