#pragma once
// A callable seen from elsewhere, as std::function without a copy and without memory of its own.
#include <memory>
#include <type_traits>
#include <utility>

namespace railstrata {

template <class Signature>
class CallableRef;

/// Refers to a callable that lives longer: it takes named ones only.
template <class Result, class... Args>
class CallableRef<Result(Args...)> {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cv_t<F>, CallableRef> && std::is_invocable_r_v<Result, F&, Args...>)
      CallableRef(F& f)  // NOLINT(google-explicit-constructor): stands in for the callable
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
        call_([](void* object, Args... args) -> Result {
          return (*static_cast<F*>(object))(std::forward<Args>(args)...);
        }) {}

  Result operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }

 private:
  void* object_;
  Result (*call_)(void*, Args...);
};

}  // namespace railstrata
