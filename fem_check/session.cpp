#include "fem_check/session.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <string>

#include "fem_check/deal_ii.hpp"

namespace vehd::fem_check {

struct Session::Implementation {
  std::string program = "vehd_fem";
  std::array<char*, 2> words{program.data(), nullptr};
  int count = 1;
  char** arguments = words.data();
  dealii::Utilities::MPI::MPI_InitFinalize mpi{count, arguments, 1};
};

Session::Session() {
  // A single process of Open MPI 4 needs neither a daemon nor a folder. All processes of a user
  // share this folder; one that ends may remove it just after another has created it. Ranks have that of their mpirun.
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  implementation_.reset(new Implementation);
  // OpenBLAS, if installed as the BLAS, would start threads for every small dense product.
  using SetThreads = void (*)(int);
  if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<SetThreads>(symbol)(1);
}

Session::~Session() = default;

int Session::rank() const { return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)); }
int Session::n_ranks() const { return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)); }

}  // namespace vehd::fem_check
