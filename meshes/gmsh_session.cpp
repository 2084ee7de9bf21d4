#include "meshes/gmsh_session.hpp"

#include <gmsh.h>

#include <cstdlib>
#include <exception>

namespace vehd::meshes {

GmshSession::GmshSession() {
  constexpr bool kReadUserFiles = false;
  gmsh::initialize(0, nullptr, kReadUserFiles);
  gmsh::option::setNumber("General.Terminal", 0);
  constexpr double kThrow = 2;
  gmsh::option::setNumber("General.AbortOnError", kThrow);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Mesh.MaxNumThreads1D", 1);
  gmsh::option::setNumber("Mesh.MaxNumThreads2D", 1);
  gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1);
  gmsh::option::setNumber("Mesh.RandomSeed", 1);
  // gmsh's meshers also use the C library's generator, whose state persists between sessions.
  std::srand(1);
  gmsh::model::add("vehd");
}

GmshSession::~GmshSession() { gmsh::finalize(); }

std::string gmsh_message() {
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (const std::string& text) {
    return text;
  } catch (const char* text) {
    return text;
  } catch (int) {
    // The message is in gmsh's log.
  }
  std::string last;
  gmsh::logger::getLastError(last);
  return last.empty() ? "gmsh gives no reason" : last;
}

}  // namespace vehd::meshes
