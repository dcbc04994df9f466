# SPDX-License-Identifier: Apache-2.0
# Rscript rao_reference.R: writes rao_reference.json beside itself. The test reads it, without R.
#
# Rao's score statistic of a regressor that is added to a linear model with known standard deviation 1, and the
# coefficient of the larger model: anova.glm(test = "Rao") and glm() of R. The data are a formula, so that both sides
# have the same numbers: fractions of multiples of the golden ratio for errors, and a shape that the base lacks.
here <- dirname(sub("--file=", "", grep("--file=", commandArgs(), value = TRUE)))
rows <- 60
u <- (0:(rows - 1)) / (rows - 1)
k <- 1:rows
y <- 3 * u + 0.02 * exp(4 * u) + sqrt(12) * ((k * (sqrt(5) - 1) / 2) %% 1 - 0.5) + 1.5 * sin(9 * u)
base <- cbind(u, exp(4 * u), sin(2 * u), cos(11 * u))
shapes <- list(sin_9 = sin(9 * u), cos_25 = cos(25 * u), step = as.numeric(u > 0.7), growing = u * sin(14 * u),
               cube = u^3, sin_70 = sin(70 * u))
lines <- sapply(names(shapes), function(name) {
  smaller <- glm(y ~ base - 1)
  larger <- glm(y ~ base + shapes[[name]] - 1)
  rao <- anova(smaller, larger, test = "Rao", dispersion = 1)
  sprintf('    "%s": {"score": %.15g, "coefficient": %.15g}', name, rao$Rao[2], coef(larger)[5])
})
cat(sprintf('{\n  "source": "rao_reference.R: %s",\n  "shapes": {\n%s\n  }\n}\n', R.version.string,
            paste(lines, collapse = ",\n")), file = file.path(here, "rao_reference.json"))
