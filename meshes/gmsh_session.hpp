#pragma once

#include <string>

namespace vehd::meshes {

/// gmsh is one global library: it lives from construction to destruction, with one empty model, silent, single-threaded
/// and with fixed seeds, so that the same input gives the same mesh. Sessions do not nest.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// Message of the exception in flight when a gmsh call threw; gmsh throws more than one type.
std::string gmsh_message();

}  // namespace vehd::meshes
