// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cards/card.hpp"

namespace tunica::cards {

namespace {

// Abaqus User Subroutines Reference, UANISOHYPER_INV: invariants I1, I2, J, then I4 and I5 of every pair (α ≤ β) of
// local directions. I4 of a direction i with itself is number i² + i + 2. Symmetric matrices are packed by columns.
const char* const source = R"(C     UANISOHYPER_INV for the fibre models of tunica, written by tunica.
C
C     U = mu/2 (I1 - 3) + sum over families of
C         k1/(2 k2) {exp[k2 E**2] - 1},
C         E = A I1 + B I4 + (1 - 3A - B) IN - 1,
C     plus 1/D [(J**2 - 1)/2 - ln J] where the card is compressible.
C
C     hgo, four_fibre: A = 0, B = 1. gho: A = kappa, B = 1 - 3 kappa.
C     holzapfel_2015 (J. R. Soc. Interface 12:20150188): A, B as fitted.
C     The families are the first local directions. IN, the squared
C     stretch along the normal of the wall, is that of the local
C     direction after them; it is there where 1 - 3A - B is not 0.
C
C     props: mu, D, switch, then k1, k2, A, B of every family.
C     switch: 0 = a family acts while E >= 0 (strain),
C     1 = while I4 >= 1 (stretch), 2 = always (none).
C
      subroutine uanisohyper_inv(aInv, ua, zeta, nFibers, nInv,
     &  ui1, ui2, ui3, temp, noel, cmname, incmpFlag, ihybFlag,
     &  numStatev, statev, numFieldv, fieldv, fieldvInc,
     &  numProps, props)
      include 'aba_param.inc'
      character*80 cmname
      dimension aInv(nInv), ua(2), zeta(nFibers*(nFibers-1)/2),
     &  ui1(nInv), ui2(nInv*(nInv+1)/2), ui3(nInv*(nInv+1)/2),
     &  statev(numStatev), fieldv(numFieldv), fieldvInc(numFieldv),
     &  props(numProps)
      dimension iAt(3), weight(3)
      logical active
C
      do 10 k = 1, nInv
        ui1(k) = 0.d0
   10 continue
      do 20 k = 1, nInv*(nInv+1)/2
        ui2(k) = 0.d0
        ui3(k) = 0.d0
   20 continue
      ua(2) = 0.5d0*props(1)*(aInv(1) - 3.d0)
      ui1(1) = 0.5d0*props(1)
      mode = nint(props(3))
      nFamilies = (numProps - 3)/4
      nNormal = nFamilies + 1
C
      do 60 i = 1, nFamilies
        rk1 = props(4*i)
        rk2 = props(4*i+1)
        weight(1) = props(4*i+2)
        weight(2) = props(4*i+3)
        weight(3) = 1.d0 - 3.d0*weight(1) - weight(2)
        iAt(1) = 1
        iAt(2) = i*i + i + 2
        iAt(3) = nNormal*nNormal + nNormal + 2
        nTerms = 3
        if (abs(weight(3)) .lt. 1.d-9) nTerms = 2
        if (nTerms .eq. 3 .and. nFibers .lt. nNormal) call xit
        e = -1.d0
        do 30 k = 1, nTerms
          e = e + weight(k)*aInv(iAt(k))
   30   continue
        active = mode .eq. 2 .or. (mode .eq. 1 .and.
     &    aInv(iAt(2)) .ge. 1.d0) .or. (mode .eq. 0 .and.
     &    e .ge. 0.d0)
        if (.not. active) goto 60
        q = rk2*e*e
        growth = exp(q)
C       (exp(q) - 1)/q without cancellation, and for k2 = 0
        if (q .lt. 1.d-2) then
          rise = 1.d0 + q/2.d0*(1.d0 + q/3.d0*(1.d0 +
     &      q/4.d0*(1.d0 + q/5.d0*(1.d0 + q/6.d0))))
        else
          rise = (growth - 1.d0)/q
        end if
        ua(2) = ua(2) + 0.5d0*rk1*e*e*rise
        first = rk1*e*growth
        second = rk1*(1.d0 + 2.d0*q)*growth
        do 50 k = 1, nTerms
          ui1(iAt(k)) = ui1(iAt(k)) + first*weight(k)
          do 40 l = k, nTerms
            m = iAt(k) + iAt(l)*(iAt(l) - 1)/2
            ui2(m) = ui2(m) + second*weight(k)*weight(l)
   40     continue
   50   continue
   60 continue
C
      ua(1) = ua(2)
      if (incmpFlag .eq. 0 .and. props(2) .gt. 0.d0) then
        d = props(2)
        aJ = aInv(3)
        ua(1) = ua(1) + (0.5d0*(aJ*aJ - 1.d0) - log(aJ))/d
        ui1(3) = (aJ - 1.d0/aJ)/d
        ui2(6) = (1.d0 + 1.d0/(aJ*aJ))/d
        ui3(6) = -2.d0/(d*aJ**3)
      end if
      return
      end
)";

}  // namespace

std::string uanisohyper_inv() { return source; }

}  // namespace tunica::cards
