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

/// A method that could not do its work, through no fault of the input: a program of somebody else's crashed, ran out of time or memory, or
/// gave back nothing that is a mesh. The message says which and why. The program answers it with exit code 1.
class MethodFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A method that needs a program that is not installed here; the message says which and how to get it.
class NotInstalled : public MethodFailed {
 public:
  using MethodFailed::MethodFailed;
};

/// How the program begins its message of a method that is not installed, for programs that run it.
inline constexpr const char* kNotInstalledPrefix = "not installed: ";

/// The progress callback asked to stop.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace smopt
