! Neo-Hooke with isotropic damage, which the largest energy of shape so far drives.
!
!   tau = (1 - D) tau_0,   D = D_max (1 - exp(-h / eta)),   h = max of W_shape over the history
!   W_0 = W_shape + W_volume = mu/2 (tr bbar - 3) + kappa/2 (J - 1)**2
!
! Since the volume's energy does not damage, DDSDDE is not symmetric while damage grows.
!
! PROPS   1 shear modulus mu, 2 bulk modulus kappa, 3 D_max (below 1), 4 energy eta at which damage sets in
! STATEV  1 the largest energy of shape h, 2 damage D
! DDSDDE  Jaumann rate of the Kirchhoff stress, over J; while damage grows less D' tau_0 (dev tau_0)
! SSE     (1 - D) W_0, of the volume at rest; SPD what damage has released
module intact_neo_hooke
  implicit none
  real(8), parameter :: one(3, 3) = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])

contains

  pure function determinant(a)
    real(8), intent(in) :: a(3, 3)
    real(8) :: determinant
    determinant = a(1, 1)*(a(2, 2)*a(3, 3) - a(2, 3)*a(3, 2)) - a(1, 2)*(a(2, 1)*a(3, 3) - a(2, 3)*a(3, 1)) &
        + a(1, 3)*(a(2, 1)*a(3, 2) - a(2, 2)*a(3, 1))
  end function determinant

  pure function trace(a)
    real(8), intent(in) :: a(3, 3)
    real(8) :: trace
    trace = a(1, 1) + a(2, 2) + a(3, 3)
  end function trace

  pure function deviator(a)
    real(8), intent(in) :: a(3, 3)
    real(8) :: deviator(3, 3)
    deviator = a - trace(a)/3*one
  end function deviator

  ! Kirchhoff stress of isochoric b and J
  pure function kirchhoff(mu, kappa, b, j)
    real(8), intent(in) :: mu, kappa, b(3, 3), j
    real(8) :: kirchhoff(3, 3)
    kirchhoff = mu*deviator(b) + kappa*j*(j - 1)*one
  end function kirchhoff

  ! Its Jaumann rate under the rate of deformation d
  pure function rate(mu, kappa, b, j, d)
    real(8), intent(in) :: mu, kappa, b(3, 3), j, d(3, 3)
    real(8) :: rate(3, 3), h(3, 3)
    h = matmul(d, b) + matmul(b, d) - 2d0/3*trace(d)*b
    rate = mu*deviator(h) + kappa*j*(2*j - 1)*trace(d)*one
  end function rate
end module intact_neo_hooke

subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, &
    stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, &
    nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt, &
    layer, kspt, jstep, kinc)
  use intact_neo_hooke
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  real(8) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl
  real(8) :: ddsddt(ntens), drplde(ntens), drpldt, stran(ntens), dstran(ntens)
  real(8) :: time(2), dtime, temp, dtemp, predef(1), dpred(1), props(nprops), coords(3)
  real(8) :: drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)

  integer, parameter :: row(6) = [1, 2, 3, 1, 1, 2], column(6) = [1, 2, 3, 2, 3, 3]
  real(8) :: mu, kappa, limit, eta, j, w, shape, grown, damage, slope
  real(8) :: b(3, 3), tau(3, 3), d(3, 3), turned(3, 3)
  integer :: k, l

  ddsdde = 0
  j = determinant(dfgrd1)
  if (.not. j > 0) then
    pnewdt = 0.25d0
    return
  end if
  mu = props(1)
  kappa = props(2)
  limit = props(3)
  eta = props(4)
  b = j**(-2d0/3)*matmul(dfgrd1, transpose(dfgrd1))
  shape = mu/2*(trace(b) - 3)
  w = shape + kappa/2*(j - 1)**2
  tau = kirchhoff(mu, kappa, b, j)

  grown = max(statev(1), shape)
  damage = limit*(1 - exp(-grown/eta))
  slope = 0
  if (shape > statev(1)) slope = limit/eta*exp(-grown/eta)

  do k = 1, ntens
    stress(k) = (1 - damage)*tau(row(k), column(k))/j
  end do
  do l = 1, ntens
    d = 0
    d(row(l), column(l)) = 0.5d0
    d(column(l), row(l)) = d(column(l), row(l)) + 0.5d0
    ! The power of the intact stress's deviator is the rate of the energy of shape.
    turned = (1 - damage)*rate(mu, kappa, b, j, d) - slope*tau*sum(deviator(tau)*d)
    do k = 1, ntens
      ddsdde(k, l) = turned(row(k), column(k))/j
    end do
  end do

  sse = (1 - damage)*w
  spd = spd + w*(damage - statev(2))
  statev(1) = grown
  statev(2) = damage
end subroutine umat
