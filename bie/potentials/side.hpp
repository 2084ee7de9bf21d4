#pragma once

namespace vehd {

/// Which limit a potential takes at a point on the membrane. Points off the membrane stand on a side of their own.
enum class Side { interior, exterior, principal_value };

}  // namespace vehd
