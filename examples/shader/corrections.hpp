// Evaluates the tables that `albedo shader` writes: functions of cos(theta) at the nodes (i/(size - 1))^2.
// T is float or double; one function is `size` numbers, the next one follows.
#pragma once

#include <algorithm>
#include <cmath>

namespace shader {

// Linear interpolation in sqrt(cos(theta)), which is where a texture unit finds it, too.
template <class T>
T lookup(const T* function, int size, T cos_theta) {
  const T place = std::sqrt(cos_theta) * T(size - 1);
  const int i = std::min(static_cast<int>(place), size - 2);
  return function[i] + (place - T(i)) * (function[i + 1] - function[i]);
}

enum class Control { none, step, total };

// What f(L,V) is multiplied with after `times` pumpings: the functions are 1/a_0, 1/a_1, ...
template <class T>
T pumping(const T* functions, int times, int size, T cos_l, T cos_v, Control control = Control::none) {
  const T most = 1 / std::max(cos_l, cos_v);
  T factor = 1;
  for (int k = 0; k < times; ++k) {
    T g = std::min(lookup(functions + k * size, size, cos_l), lookup(functions + k * size, size, cos_v));
    if (control == Control::step) g = std::min(g, most);
    factor *= g;
    if (control == Control::total) factor = std::min(factor, most);
  }
  return factor;
}

// What f(L,V) is multiplied with: the function is 1/s.
template <class T>
T balance(const T* function, int size, T cos_l, T cos_v) {
  return lookup(function, size, cos_l) * lookup(function, size, cos_v);
}

// What is added to f(L,V): the function is m.
template <class T>
T multiscatter(const T* function, int size, T cos_l, T cos_v) {
  return lookup(function, size, cos_l) * lookup(function, size, cos_v);
}

// What f(L,V) is multiplied with: the function is 1/a, and rho is the share of the lost light that comes back.
template <class T>
T turquin(const T* function, int size, T cos_l, T rho = 1) {
  return 1 - rho + rho * lookup(function, size, cos_l);
}

}  // namespace shader
