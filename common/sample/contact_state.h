// Contact state of a vertex of the gel's front.
#pragma once

#include <array>
#include <cstdint>

namespace tacipc {

/// The numbers are stored in contact_state.npy.
enum class ContactState : std::uint8_t { none = 0, stick = 1, slip = 2 };

/// Names of the states, in the order of the enum.
inline constexpr std::array kContactStateNames{"no contact", "stick", "slip"};

}  // namespace tacipc
