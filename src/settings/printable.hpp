/// A text from a file without the control characters that would steer a terminal.
#pragma once

#include <string>
#include <string_view>

namespace rubatlas::settings {

/// Leaves out U+0000 to U+001F and U+007F to U+009F; bytes that are no UTF-8 become question marks.
std::string printable(std::string_view text);

}  // namespace rubatlas::settings
