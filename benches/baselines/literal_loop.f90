! The law as the thesis prints it (see literal.f90), as a loop for the vectoriser: component-major arrays, no call, no
! branch, six components of symmetric tensors.
subroutine literal_block(n, ld, properties, f, stress, energies, invariants, failure, status) bind(C)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), value :: n, ld
  real(c_double), intent(in) :: properties(11), f(ld, 9)
  real(c_double), intent(inout) :: stress(ld, 6), energies(ld, 4), invariants(ld, 4), failure(ld, 3)
  integer(c_int), intent(inout) :: status(ld)
  real(c_double) :: kel, ktc, p, ktd, kld, alpha, beta, ilim, limited, m1, m2, m3, m(3)
  real(c_double) :: f11, f21, f31, f12, f22, f32, f13, f23, f33, j, rj
  real(c_double) :: c11, c22, c33, c12, c23, c31, n1, n2, n3, d11, d22, d33, d12, d23, d31
  real(c_double) :: i1, i3, i4, i5, iel, itc, itd, ild, tension, compaction, q, r3, r4, root, powered
  real(c_double) :: s_el, s_tc, s_td, s_ld, s_1, s_inverse, s_mm, s_sym, s11, s22, s33, s12, s23, s31
  real(c_double) :: g11, g21, g31, g12, g22, g32, g13, g23, g33, index
  logical :: inverted, keeps
  integer :: i

  kel = properties(1); ktc = properties(2); p = properties(3); ktd = properties(4); kld = properties(5)
  limited = merge(1d0, 0d0, properties(6) > 0)
  ilim = log(1 + merge(properties(6), 1d0, properties(6) > 0))
  alpha = properties(7); beta = properties(8)
  m = properties(9:11)/norm2(properties(9:11))
  m1 = m(1); m2 = m(2); m3 = m(3)

  !$omp simd
  do i = 1, n
    f11 = f(i,1); f21 = f(i,2); f31 = f(i,3)
    f12 = f(i,4); f22 = f(i,5); f32 = f(i,6)
    f13 = f(i,7); f23 = f(i,8); f33 = f(i,9)
    j = f11*(f22*f33 - f23*f32) - f12*(f21*f33 - f23*f31) + f13*(f21*f32 - f22*f31)
    rj = 1/j

    c11 = f11*f11 + f21*f21 + f31*f31
    c22 = f12*f12 + f22*f22 + f32*f32
    c33 = f13*f13 + f23*f23 + f33*f33
    c12 = f11*f12 + f21*f22 + f31*f32
    c23 = f12*f13 + f22*f23 + f32*f33
    c31 = f13*f11 + f23*f21 + f33*f31
    n1 = c11*m1 + c12*m2 + c31*m3
    n2 = c12*m1 + c22*m2 + c23*m3
    n3 = c31*m1 + c23*m2 + c33*m3
    ! The adjugate of C, which is I3 times its inverse.
    d11 = c22*c33 - c23*c23
    d22 = c11*c33 - c31*c31
    d33 = c11*c22 - c12*c12
    d12 = c31*c23 - c12*c33
    d23 = c12*c31 - c23*c11
    d31 = c12*c23 - c31*c22
    i1 = c11 + c22 + c33
    i3 = c11*d11 + c12*d12 + c31*d31
    i4 = m1*n1 + m2*n2 + m3*n3
    i5 = n1*n1 + n2*n2 + n3*n3
    r3 = 1/i3
    r4 = 1/i4

    q = i1*i4 - i5
    root = max(q*q - 4*i3*i4, 0d0)
    iel = 0.5d0*log(i4)
    itc = 0.25d0*log(i3*r4)
    ! acosh x = ln(x + sqrt(x^2 - 1)), whose root is Eq. 4.14's own.
    itd = 0.5d0*log((q + sqrt(root))/(2*sqrt(i3*i4)))
    ild = sqrt(max(i5*r4*r4 - 1, 0d0))
    tension = max(iel, 0d0)
    compaction = max(-itc, 0d0)
    powered = ktc*merge(exp((p - 1)*log(max(compaction, 1d-300))), 0d0, compaction > 0)

    s_el = kel*tension*r4
    s_tc = 0.5d0*p*powered
    s_td = merge(0.5d0*ktd*itd/sqrt(max(root, 1d-300)), 0d0, root > 0)
    s_ld = kld*r4*r4
    ! S = s_1 1 + s_inverse adj C + s_mm M + s_sym (CM + MC)
    s_1 = 2*i4*s_td
    s_inverse = -(s_tc + q*s_td)*r3
    s_mm = s_el + s_tc*r4 + (i1 + i5*r4)*s_td - 2*i5*r4*s_ld
    s_sym = s_ld - 2*s_td
    s11 = s_1 + s_inverse*d11 + (s_mm*m1 + 2*s_sym*n1)*m1
    s22 = s_1 + s_inverse*d22 + (s_mm*m2 + 2*s_sym*n2)*m2
    s33 = s_1 + s_inverse*d33 + (s_mm*m3 + 2*s_sym*n3)*m3
    s12 = s_inverse*d12 + s_mm*m1*m2 + s_sym*(n1*m2 + n2*m1)
    s23 = s_inverse*d23 + s_mm*m2*m3 + s_sym*(n2*m3 + n3*m2)
    s31 = s_inverse*d31 + s_mm*m3*m1 + s_sym*(n3*m1 + n1*m3)

    g11 = f11*s11 + f12*s12 + f13*s31
    g21 = f21*s11 + f22*s12 + f23*s31
    g31 = f31*s11 + f32*s12 + f33*s31
    g12 = f11*s12 + f12*s22 + f13*s23
    g22 = f21*s12 + f22*s22 + f23*s23
    g32 = f31*s12 + f32*s22 + f33*s23
    g13 = f11*s31 + f12*s23 + f13*s33
    g23 = f21*s31 + f22*s23 + f23*s33
    g33 = f31*s31 + f32*s23 + f33*s33

    inverted = j <= 0
    keeps = inverted .or. failure(i,2) >= 0.5d0
    rj = merge(0d0, rj, keeps)
    stress(i,1) = merge(0d0, rj*(g11*f11 + g12*f12 + g13*f13), keeps)
    stress(i,2) = merge(0d0, rj*(g21*f21 + g22*f22 + g23*f23), keeps)
    stress(i,3) = merge(0d0, rj*(g31*f31 + g32*f32 + g33*f33), keeps)
    stress(i,4) = merge(0d0, rj*(g11*f21 + g12*f22 + g13*f23), keeps)
    stress(i,5) = merge(0d0, rj*(g21*f31 + g22*f32 + g23*f33), keeps)
    stress(i,6) = merge(0d0, rj*(g31*f11 + g32*f12 + g33*f13), keeps)
    energies(i,1) = merge(energies(i,1), 0.5d0*kel*tension*tension, keeps)
    energies(i,2) = merge(energies(i,2), powered*compaction, keeps)
    energies(i,3) = merge(energies(i,3), 0.5d0*ktd*itd*itd, keeps)
    energies(i,4) = merge(energies(i,4), 0.5d0*kld*ild*ild, keeps)
    invariants(i,1) = merge(invariants(i,1), iel, keeps)
    invariants(i,2) = merge(invariants(i,2), itc, keeps)
    invariants(i,3) = merge(invariants(i,3), itd, keeps)
    invariants(i,4) = merge(invariants(i,4), ild, keeps)
    index = merge(limited*(iel/ilim + alpha*compaction + beta*itd), 0d0, iel > 0)
    failure(i,1) = merge(failure(i,1), index, keeps)
    failure(i,2) = merge(failure(i,2), merge(1d0, 0d0, index >= 1), keeps)
    failure(i,3) = 1 - failure(i,2)
    status(i) = merge(-301, 0, inverted .and. .not. failure(i,2) >= 0.5d0)
  end do
end subroutine
