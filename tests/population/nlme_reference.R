# SPDX-License-Identifier: Apache-2.0
# Rscript nlme_reference.R: writes nlme_data.csv and nlme_reference.json beside itself. The test reads both, without R.
#
# 18 specimens of 6 animals, stress = a (exp(b e) - 1) + noise, log a and log b with effects of animals, of specimens and
# of a treatment. Two fits by restricted likelihood, spreads without correlation:
#   treated: fixed log a, log b ~ treatment, random effects of specimens;
#   nested:  fixed log a, log b ~ 1, random effects of animals and of specimens within them.
# J. C. Pinheiro, D. M. Bates, Mixed-Effects Models in S and S-PLUS (2000); package nlme.
#
# nlme() with REML restricts the residual variance only: its spreads are those of ML but for one common factor. lme() on
# the linearised curve restricts all of them. So means and standard errors come from nlme() here, spreads and the
# restricted likelihood from lme() at the linearisation of nlme(), and the full likelihood from nlme() with ML.
suppressMessages(library(nlme))
RNGkind("Mersenne-Twister", "Inversion")
set.seed(20180)

animals <- 6; each <- 3; e <- 0.4 * (1:20) / 20
data <- NULL
for (k in 1:animals) {
  of_animal <- c(0.25, 0.10) * rnorm(2)
  for (i in 1:each) {
    treated <- (i + k) %% 2
    xi <- log(c(10, 6)) + of_animal + c(0.2, 0.12) * rnorm(2) + treated * c(0.3, 0)
    stress <- exp(xi[1]) * (exp(exp(xi[2]) * e) - 1) + 2 * rnorm(length(e))
    data <- rbind(data, data.frame(animal = sprintf("animal%d", k), specimen = sprintf("s%02d", each * (k - 1) + i),
                                   treated = treated, strain = e, stress = round(stress, 6)))
  }
}
here <- dirname(sub("--file=", "", grep("--file=", commandArgs(), value = TRUE)))
write.csv(data, file.path(here, "nlme_data.csv"), row.names = FALSE, quote = FALSE)

curve <- stress ~ exp(la) * (exp(exp(lb) * strain) - 1)
control <- nlmeControl(tolerance = 1e-8, pnlsTol = 1e-9, msTol = 1e-10, maxIter = 500, opt = "nlminb")
treated <- nlme(curve, data = data, fixed = list(la ~ treated, lb ~ treated), random = list(specimen = pdDiag(la + lb ~ 1)),
                start = c(log(10), 0, log(6), 0), method = "REML", control = control)
nested <- nlme(curve, data = data, fixed = la + lb ~ 1,
               random = list(animal = pdDiag(la + lb ~ 1), specimen = pdDiag(la + lb ~ 1)),
               start = log(c(10, 6)), method = "REML", control = control)

# lme() on the curve linearised at the coefficients of the specimens.
linearised <- function(fit, random) {
  own <- data
  of_specimen <- coef(fit)
  rows <- of_specimen[if (is.null(of_specimen[data$specimen[1], 1]) || is.na(of_specimen[data$specimen[1], 1]))
                        paste(data$animal, data$specimen, sep = "/") else data$specimen, , drop = FALSE]
  la <- rows[, 1]; lb <- rows[, ncol(rows) / 2 + 1]
  if (ncol(rows) == 4) { la <- la + rows[, 2] * data$treated; lb <- lb + rows[, 4] * data$treated }
  own$J1 <- exp(la) * (exp(exp(lb) * data$strain) - 1)
  own$J2 <- exp(la) * exp(lb) * data$strain * exp(exp(lb) * data$strain)
  own$w <- data$stress - own$J1 + own$J1 * la + own$J2 * lb
  formula <- if (ncol(rows) == 4) w ~ 0 + J1 + J2 + J1:treated + J2:treated else w ~ 0 + J1 + J2
  lme(formula, data = own, random = random, method = "REML",
      control = lmeControl(msTol = 1e-10, tolerance = 1e-9, maxIter = 500, msMaxIter = 500))
}
steps <- pdDiag(~ 0 + J1 + J2)
linear_treated <- linearised(treated, list(specimen = steps))
linear_nested <- linearised(nested, list(animal = steps, specimen = steps))
full_treated <- update(treated, method = "ML")

numbers <- function(x) paste0("[", paste(sprintf("%.10g", x), collapse = ", "), "]")
se <- function(fit) sqrt(diag(vcov(fit)))
spreads <- function(fit) {
  found <- suppressWarnings(as.numeric(VarCorr(fit)[, "StdDev"]))
  found[!is.na(found)]
}
order <- c(1, 3, 2, 4)  # both parameters of the reference, then both effects
cat(sprintf('{
  "source": "nlme_reference.R: %s, nlme %s",
  "treated": {"mean": %s, "standard_error": %s, "noise": %.10g,
              "spread": %s, "restricted_log_likelihood": %.10g, "full_log_likelihood": %.10g},
  "nested": {"mean": %s, "standard_error": %s, "noise": %.10g,
             "spread_animal": %s, "spread_specimen": %s, "restricted_log_likelihood": %.10g}
}
', R.version.string, packageVersion("nlme"),
  numbers(fixef(treated)[order]), numbers(se(treated)[order]), treated$sigma,
  numbers(spreads(linear_treated)[1:2]), as.numeric(logLik(linear_treated)), as.numeric(logLik(full_treated)),
  numbers(fixef(nested)), numbers(se(nested)), nested$sigma,
  numbers(spreads(linear_nested)[1:2]), numbers(spreads(linear_nested)[3:4]), as.numeric(logLik(linear_nested))),
  file = file.path(here, "nlme_reference.json"))
