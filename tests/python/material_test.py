# SPDX-License-Identifier: Apache-2.0
"""A model at given deformations, against closed forms and differences."""
import numpy

import tunica
from support import Case

GENERATOR_SEED = 20261123


def deformations(n):
    """Random deformation gradients near the identity, with positive determinants."""
    generator = numpy.random.default_rng(GENERATOR_SEED)
    return numpy.eye(3) + 0.2 * generator.uniform(-1, 1, (n, 3, 3))


class Materials(Case):
    def test_neo_hooke_is_its_closed_form(self):
        material = tunica.Material("neo_hooke", mu=30.0)
        F = deformations(20)
        C = numpy.einsum("nki,nkj->nij", F, F)
        numpy.testing.assert_allclose(material.energy(F=F), 15 * (numpy.trace(C, axis1=1, axis2=2) - 3), rtol=1e-12)
        # S = 2 ∂W/∂C = mu 1, and no more: pressure is the test's.
        numpy.testing.assert_allclose(material.stress(C=C), 30 * numpy.broadcast_to(numpy.eye(3), C.shape), atol=1e-12)
        numpy.testing.assert_allclose(material.cauchy(F=F), 30 * numpy.einsum("nik,njk->nij", F, F)
                                      / numpy.linalg.det(F)[:, None, None], rtol=1e-12, atol=1e-12)
        stretches = numpy.array([[1.2, 1, 1 / 1.2], [0.9, 1.3, 0.8]])
        numpy.testing.assert_array_equal(material.cauchy(stretches=stretches),
                                         material.cauchy(F=stretches[:, :, None] * numpy.eye(3)))
        for neither in ({}, {"F": F, "stretches": stretches}):
            with self.assertRaisesRegex(tunica.InputError, "either F or stretches"):
                material.cauchy(**neither)

    def test_stress_is_the_gradient_of_the_energy_and_the_tangent_that_of_the_stress(self):
        material = tunica.Material("gho", mu=10.0, k1=20.0, k2=2.0)
        F = deformations(5)
        C = numpy.einsum("nki,nkj->nij", F, F)
        stress, tangent = material.stress(C=C), material.tangent(C=C)
        h = 1e-6
        for b, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))):
            step = numpy.zeros((3, 3))
            step[i, j] = step[j, i] = h
            once = 1 if i == j else 2  # an off-diagonal entry stands twice
            slope = (material.energy(C=C + step) - material.energy(C=C - step)) / (2 * h)
            numpy.testing.assert_allclose(stress[:, i, j], 2 * slope / once, rtol=1e-6, atol=1e-5)
            change = (material.stress(C=C + step) - material.stress(C=C - step)) / (2 * h)
            for a, (k, m) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))):
                numpy.testing.assert_allclose(tangent[:, a, b], 2 * change[:, k, m] / once, rtol=1e-5, atol=1e-4)

    def test_stretches_are_deformations_along_the_axes(self):
        material = tunica.Material("yeoh")
        stretches = numpy.array([[1.2, 0.9, 1.1], [2.0, 0.7, 0.7]])
        numpy.testing.assert_array_equal(material.energy(stretches=stretches),
                                         material.energy(C=numpy.array([numpy.diag(s**2) for s in stretches])))

    def test_memory_follows_the_path(self):
        entry = {"type": "neo_hooke", "mechanisms": [{"type": "viscoelasticity"}]}
        held = numpy.repeat([[1.5, 1.0, 1.0]], 4, axis=0)
        material = tunica.Material(entry)
        material.parameters.update({name: value for name, value in
                                    zip(material.parameters, (30.0, 1.0, 1.0))})
        stress = material.stress(stretches=held, time_step=[0.0, 1.0, 1.0, 1.0])[:, 0, 0]
        self.assertTrue((numpy.diff(stress) < 0).all(), f"a held stretch relaxes: {stress}")

    def test_wrong_deformations_and_names_are_refused(self):
        material = tunica.Material("neo_hooke")
        for wrong in ({}, {"C": numpy.eye(3), "F": numpy.eye(3)}, {"C": numpy.eye(2)},
                      {"C": numpy.eye(3) + numpy.triu(numpy.ones((3, 3)), 1)}, {"stretches": [1.0]}):
            with self.assertRaises(tunica.InputError):
                material.energy(**wrong)
        with self.assertRaisesRegex(tunica.InputError, "mu"):
            tunica.Material("neo_hooke", shear=1.0)
        with self.assertRaisesRegex(tunica.InputError, "neo_hooke"):
            tunica.Material("neo_hoke")
