#pragma once

#include <string>

namespace vehd::meshes {

/// Initialises gmsh, which is one global library, and finalises it on destruction: one empty model, silent,
/// single-threaded and with fixed seeds, so that equal input gives equal meshes. Sessions cannot be nested.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// Message of the current exception thrown by a gmsh call; gmsh throws exceptions of several types.
std::string gmsh_message();

}  // namespace vehd::meshes
