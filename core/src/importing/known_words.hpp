// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "importing/columns.hpp"

/// What quantities are called in the headers of testing machines: English, German, French, Spanish, Italian. Spelling
/// as for has_word().
namespace tunica::importing {

/// A quantity, what its columns are called, and the base unit that its unit must convert to. The first that fits.
struct Word {
  const char* word;
  const char* quantity;
  const char* base;
  bool needs_unit = false;  ///< the word says too little without one
};
inline constexpr Word known_words[] = {{"pressure", "pressure", "kPa"},
                                       {"=druck", "pressure", "kPa"},
                                       {"innendruck", "pressure", "kPa"},
                                       {"pression", "pressure", "kPa"},
                                       {"presion", "pressure", "kPa"},
                                       {"stretch", "stretch", "1"},
                                       {"streckung", "stretch", "1"},
                                       {"lambda", "stretch", "1"},
                                       {"strain", "strain", "1"},
                                       {"dehnung", "strain", "1"},
                                       {"stauchung", "strain", "1"},
                                       {"deformation", "strain", "1"},
                                       {"deformacion", "strain", "1"},
                                       {"deformazione", "strain", "1"},
                                       {"=epsilon", "strain", "1"},
                                       {"=eps", "strain", "1"},
                                       {"=exx", "strain", "1"},
                                       {"=eyy", "strain", "1"},
                                       {"=exy", "strain", "1"},
                                       {"stress", "stress", "kPa"},
                                       {"spannung", "stress", "kPa"},
                                       {"contrainte", "stress", "kPa"},
                                       {"esfuerzo", "stress", "kPa"},
                                       {"=sigma", "stress", "kPa"},
                                       {"=tension", "stress", "kPa", true},
                                       {"force", "force", "mN"},
                                       {"load", "force", "mN"},
                                       {"kraft", "force", "mN"},
                                       {"transducer", "force", "mN"},
                                       {"balance", "force", "mN"},
                                       {"fuerza", "force", "mN"},
                                       {"=carga", "force", "mN"},
                                       {"=charge", "force", "mN", true},
                                       {"effort", "force", "mN", true},
                                       {"forza", "force", "mN"},
                                       {"=f", "force", "mN", true},
                                       {"=fx", "force", "mN"},
                                       {"=fy", "force", "mN"},
                                       {"=fz", "force", "mN"},
                                       {"displacement", "displacement", "mm"},
                                       {"=disp", "displacement", "mm"},
                                       {"extension", "displacement", "mm"},
                                       {"elongation", "displacement", "mm"},
                                       {"travel", "displacement", "mm"},
                                       {"=distance", "displacement", "mm"},
                                       {"wegaufnehmer", "displacement", "mm"},
                                       {"=course", "displacement", "mm", true},
                                       {"=deform", "displacement", "mm", true},
                                       {"=pos", "displacement", "mm", true},
                                       {"stroke", "displacement", "mm"},
                                       {"crosshead", "displacement", "mm"},
                                       {"position", "displacement", "mm"},
                                       {"extensometer", "displacement", "mm"},
                                       {"weg", "displacement", "mm"},
                                       {"verlangerung", "displacement", "mm"},
                                       {"deplacement", "displacement", "mm"},
                                       {"allongement", "displacement", "mm"},
                                       {"traverse", "displacement", "mm"},
                                       {"desplazamiento", "displacement", "mm"},
                                       {"alargamiento", "displacement", "mm"},
                                       {"spostamento", "displacement", "mm"},
                                       {"deformation", "displacement", "mm", true},
                                       {"verformung", "displacement", "mm", true},
                                       {"=ux", "displacement", "mm"},
                                       {"=uy", "displacement", "mm"},
                                       {"extension", "strain", "1", true},
                                       {"elongation", "strain", "1", true},
                                       {"verlangerung", "strain", "1", true},
                                       {"verformung", "strain", "1", true},
                                       {"allongement", "strain", "1", true},
                                       {"displacement", "strain", "1", true},
                                       {"length", "length", "mm"},
                                       {"=size", "length", "mm"},
                                       {"lange", "length", "mm"},
                                       {"longueur", "length", "mm"},
                                       {"=longitud", "length", "mm"},
                                       {"time", "time", "s"},
                                       {"zeit", "time", "s"},
                                       {"temps", "time", "s"},
                                       {"tiempo", "time", "s"},
                                       {"=tempo", "time", "s"},
                                       {"=t", "time", "s"}};

/// Titles of columns in the tables of oscillations, without case and blanks, and the observable that they are. Not G'
/// and G'': they are of shear, which the test has to be told.
inline constexpr std::pair<const char*, const char*> known_titles[] = {
    {"e'", "storage_modulus"},      {"speichermodul", "storage_modulus"}, {"e''", "loss_modulus"},
    {"e\"", "loss_modulus"},        {"verlustmodul", "loss_modulus"},     {"tandelta", "loss_tangent"},
    {"tan(delta)", "loss_tangent"}, {"lossfactor", "loss_tangent"},       {"verlustfaktor", "loss_tangent"},
    {"frequenz", "frequency"}};

/// What no test takes, by a word of its name.
inline constexpr std::pair<const char*, const char*> other_words[] = {{"rate", "a rate"},
                                                                      {"speed", "a speed"},
                                                                      {"velocity", "a speed"},
                                                                      {"geschwindigkeit", "a speed"},
                                                                      {"=std", "a scatter"},
                                                                      {"=sd", "a scatter"},
                                                                      {"deviation", "a scatter"},
                                                                      {"uncertainty", "a scatter"},
                                                                      {"error", "an error"},
                                                                      {"stiffness", "a stiffness"},
                                                                      {"modulus", "a modulus"},
                                                                      {"energy", "an energy"},
                                                                      {"=work", "an energy"},
                                                                      {"frequency", "a frequency"},
                                                                      {"temperature", "temperature"},
                                                                      {"temperatur", "temperature"},
                                                                      {"torque", "torque"},
                                                                      {"torsional", "torsion"},
                                                                      {"indentation", indentation},
                                                                      {"=flex", bending},
                                                                      {"flexur", bending},
                                                                      {"bending", bending},
                                                                      {"biege", bending},
                                                                      {"viscosity", shearing},
                                                                      {"viskositat", shearing},
                                                                      {"viscosite", shearing},
                                                                      {"oscillation", "an amplitude"},
                                                                      {"amplitude", "an amplitude"},
                                                                      {"rotation", "an angle"},
                                                                      {"angle", "an angle"}};

}  // namespace tunica::importing
