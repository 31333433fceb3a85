// Result<T>: a value or an Error, for everything that bad input or the outside world can make fail.
// Programmer mistakes are checked with FREP_CHECK, which no user input may reach.
// Tested by tests/unit/base/result_test.cpp.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace frep {

/// What kind of failure an Error is; the command maps each to an exit code (docs/formats.md).
enum class ErrorKind {
    invalid_model,     ///< the model text is wrong (diagnostics say where)
    invalid_argument,  ///< an option or argument is wrong
    io,                ///< a file cannot be read or written, or its content is malformed
    over_limit,        ///< a stated limit (time, memory, steps, nodes) was exceeded
    cancelled,         ///< the caller cancelled the job
};

/// A failure with a message for people: one sentence, no trailing period, names the thing at fault.
struct Error {
    ErrorKind kind = ErrorKind::invalid_argument;
    std::string message;
};

/// Reports a broken invariant of the program and aborts. Never reachable from user input.
[[noreturn]] void check_failed(const char* condition, const char* file, int line);

#define FREP_CHECK(condition) \
    (static_cast<bool>(condition) ? void(0) : ::frep::check_failed(#condition, __FILE__, __LINE__))

/// A value of type T or an Error. Test it with operator bool before asking for the value.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }

    T& value() & {
        FREP_CHECK(state_.index() == 0);
        return *std::get_if<0>(&state_);
    }
    const T& value() const& {
        FREP_CHECK(state_.index() == 0);
        return *std::get_if<0>(&state_);
    }
    T&& value() && {
        FREP_CHECK(state_.index() == 0);
        return std::move(*std::get_if<0>(&state_));
    }
    const Error& error() const {
        FREP_CHECK(state_.index() == 1);
        return *std::get_if<1>(&state_);
    }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

  private:
    std::variant<T, Error> state_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : failed_(true), error_(std::move(error)) {}
    explicit operator bool() const { return !failed_; }
    const Error& error() const {
        FREP_CHECK(failed_);
        return error_;
    }

  private:
    bool failed_ = false;
    Error error_;
};

using Status = Result<void>;

}  // namespace frep
