! Metal plasticity (von Mises), linear kinematic and isotropic hardening, small increments.
!
!   yield at sqrt(3/2) |dev sigma - alpha| = sigma_0 + H_i p;   d alpha = 2/3 H_k d eps_p
!
! The return is along the radius and closed. STRESS comes in turned by DROT, the back stress is turned here.
!
! PROPS   1 Young's modulus, 2 Poisson's ratio, 3 sigma_0, 4 H_i, 5 H_k
! STATEV  1..NTENS back stress alpha, NTENS + 1 equivalent plastic strain
! DDSDDE  d(increment of stress)/d(increment of strain), consistent with the return
! SSE     elastic energy and that of the back stress; SPD what is dissipated
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, &
    stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, &
    nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt, &
    layer, kspt, jstep, kinc)
  implicit none
  character(len=80), intent(in) :: cmname
  integer, intent(in) :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  real(8), intent(inout) :: stress(ntens), statev(nstatv), sse, spd, scd, rpl, pnewdt
  real(8), intent(out) :: ddsdde(ntens, ntens)
  real(8), intent(inout) :: ddsddt(ntens), drplde(ntens), drpldt
  real(8), intent(in) :: stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), dpred(1)
  real(8), intent(in) :: props(nprops), coords(3), drot(3, 3), celent, dfgrd0(3, 3), dfgrd1(3, 3)

  integer, parameter :: like_stress = 1
  real(8) :: bulk, shear, yield, hardening, pressure, size, theta, dp
  real(8) :: alpha(ntens), normal(ntens), deviator(ntens), identity(ntens), half(ntens)
  integer :: j

  bulk = props(1)/(3*(1 - 2*props(2)))
  shear = props(1)/(2*(1 + props(2)))
  hardening = props(4) + props(5)
  yield = props(3) + props(4)*statev(ntens + 1)
  identity = 0
  identity(1:ndi) = 1
  half = 0.5d0 ! of an engineering shear
  half(1:ndi) = 1
  call rotsig(statev(1), drot, alpha, like_stress, ndi, nshr)

  ! Trial stress
  pressure = (sum(stress(1:ndi)) + 3*bulk*sum(dstran(1:ndi)))/3
  deviator = stress - sum(stress(1:ndi))/3*identity + 2*shear*(half*dstran - sum(dstran(1:ndi))/3*identity)
  size = mises(deviator - alpha)

  if (size > yield) then
    dp = (size - yield)/(3*shear + hardening)
    theta = 1 - 3*shear*dp/size
    normal = (deviator - alpha)/size
    deviator = deviator - 3*shear*dp*normal
    alpha = alpha + props(5)*dp*normal
    statev(ntens + 1) = statev(ntens + 1) + dp
    spd = spd + yield*dp
    do j = 1, ntens
      ddsdde(:, j) = identity*identity(j)*(bulk - 2*shear*theta/3) &
          - 3*shear*(3*shear/(3*shear + hardening) - 1 + theta)*normal*normal(j)
      ddsdde(j, j) = ddsdde(j, j) + 2*shear*theta*half(j)
    end do
  else
    do j = 1, ntens
      ddsdde(:, j) = identity*identity(j)*(bulk - 2*shear/3)
      ddsdde(j, j) = ddsdde(j, j) + 2*shear*half(j)
    end do
  end if

  statev(1:ntens) = alpha
  stress = deviator + pressure*identity
  sse = pressure**2/(2*bulk) + mises(deviator)**2/(6*shear)
  if (props(5) > 0) sse = sse + mises(alpha)**2/(2*props(5))

contains

  ! sqrt(3/2) of the length of a deviator
  pure function mises(s)
    real(8), intent(in) :: s(ntens)
    real(8) :: mises
    mises = sqrt(1.5d0*(sum(s(1:ndi)**2) + 2*sum(s(ndi + 1:)**2)))
  end function mises
end subroutine umat
