// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/quadrature.hpp>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

namespace tangency::inline v0::verify {

double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr std::size_t kMostIntervals = 1000;
  constexpr double kAbsolute = 1e-14, kRelative = 1e-11;
  const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)>
      workspace(gsl_integration_workspace_alloc(kMostIntervals), gsl_integration_workspace_free);
  gsl_function function{[](double x, void* given) {
                          return (*static_cast<const std::function<double(double)>*>(given))(x);
                        },
                        const_cast<std::function<double(double)>*>(&f)};
  double value = 0, error = 0;
  gsl_error_handler_t* const handler = gsl_set_error_handler_off();
  const int status = gsl_integration_qags(&function, from, to, kAbsolute, kRelative, kMostIntervals,
                                          workspace.get(), &value, &error);
  gsl_set_error_handler(handler);
  if (status != GSL_SUCCESS) {
    throw std::runtime_error("oracle: quadrature: " + std::string(gsl_strerror(status)));
  }
  return value;
}

}  // namespace tangency::inline v0::verify
