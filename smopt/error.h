#pragma once

#include <stdexcept>

namespace smopt {

/// Input that cannot be used: the message names the file and the line or element. The program answers it with exit code 3.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A mesh that breaks a function's precondition (not closed, not manifold, coordinates that are not finite).
class InvalidMesh : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// A caller's wrong option value; the program answers it with exit code 2.
class InvalidOption : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The progress callback asked to stop.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace smopt
