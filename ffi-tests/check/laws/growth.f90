! Growth that tension drives: F = Fe Fg, Fg = theta I, a compressible neo-Hooke for Fe.
!
!   W(Fe)    = lambda/2 ln(Je)**2 + mu/2 (tr be - 3 - 2 ln Je), of the grown volume
!   sigma    = (lambda ln Je I + mu (be - I))/Je
!   theta'   = ((theta_max - theta)/(theta_max - 1))**2 / T * (tr tau_e - m)/mu   where tr tau_e > m
!
! The increment of theta is implicit (backward Euler, Newton); DDSDDE is consistent with it, and not symmetric while
! the material grows.
!
! PROPS   1 lambda, 2 mu, 3 theta_max, 4 time T, 5 the trace m of the Mandel stress below which nothing grows
! STATEV  1 growth stretch theta, 1 at the begin (SDVINI)
! DDSDDE  Jaumann rate of the Kirchhoff stress, over J
! SSE     W theta**3, of the volume at rest
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, &
    stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, &
    nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt, &
    layer, kspt, jstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl
  double precision :: ddsddt(ntens), drplde(ntens), drpldt, stran(ntens), dstran(ntens)
  double precision :: time(2), dtime, temp, dtemp, predef(1), dpred(1), props(nprops), coords(3)
  double precision :: drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)

  integer, parameter :: row(6) = [1, 2, 3, 1, 1, 2], column(6) = [1, 2, 3, 2, 3, 3]
  double precision, parameter :: one(3, 3) = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])
  double precision :: lambda, mu, theta_max, relaxation, threshold
  double precision :: j, je, theta, excess, room, residual, slope, dtheta, mandel, low, high
  double precision :: b(3, 3), be(3, 3), tau(3, 3), d(3, 3), dbe(3, 3), dtau(3, 3), dsigma(3, 3)
  integer :: k, l, iteration
  logical :: grows, converged

  ddsdde = 0
  j = dfgrd1(1, 1)*(dfgrd1(2, 2)*dfgrd1(3, 3) - dfgrd1(2, 3)*dfgrd1(3, 2)) &
      - dfgrd1(1, 2)*(dfgrd1(2, 1)*dfgrd1(3, 3) - dfgrd1(2, 3)*dfgrd1(3, 1)) &
      + dfgrd1(1, 3)*(dfgrd1(2, 1)*dfgrd1(3, 2) - dfgrd1(2, 2)*dfgrd1(3, 1))
  if (.not. j > 0) then
    pnewdt = 0.25d0
    return
  end if
  lambda = props(1)
  mu = props(2)
  theta_max = props(3)
  relaxation = props(4)
  threshold = props(5)
  b = matmul(dfgrd1, transpose(dfgrd1))

  ! How much it grows: the residual is below 0 at the start where there is growth, and above at theta_max. Newton, and
  ! the middle of what is left where it would leave that.
  theta = statev(1)
  call evaluate
  grows = excess > 0
  if (grows) then
    low = theta
    high = theta_max
    converged = .false.
    do iteration = 1, 50
      if (residual <= 0) low = theta
      if (residual >= 0) high = theta
      dtheta = -residual/slope
      if (theta + dtheta < low .or. theta + dtheta > high) dtheta = (low + high)/2 - theta
      theta = theta + dtheta
      call evaluate
      if (abs(dtheta) <= 1d-14*theta) then
        converged = .true.
        exit
      end if
    end do
    if (.not. converged) pnewdt = 0.5d0
  end if

  tau = lambda*log(je)*one + mu*(be - one)
  do k = 1, ntens
    stress(k) = tau(row(k), column(k))/je
  end do

  do l = 1, ntens
    d = 0
    d(row(l), column(l)) = 0.5d0
    d(column(l), row(l)) = d(column(l), row(l)) + 0.5d0
    dtheta = 0
    ! The residual stays 0; the Mandel stress rises with d and falls with theta.
    if (grows) dtheta = dtime*room**2/relaxation/mu*(3*lambda*trace(d) + 2*mu*sum(be*d))/slope
    dbe = matmul(d, be) + matmul(be, d) - 2*dtheta/theta*be
    dtau = lambda*(trace(d) - 3*dtheta/theta)*one + mu*dbe
    ! The Cauchy stress, tau over Je; and its tr d for the Kirchhoff stress over J
    dsigma = (dtau - tau*(trace(d) - 3*dtheta/theta))/je
    dsigma = dsigma + tau/je*trace(d)
    do k = 1, ntens
      ddsdde(k, l) = dsigma(row(k), column(k))
    end do
  end do

  sse = theta**3*(lambda/2*log(je)**2 + mu/2*(trace(be) - 3 - 2*log(je)))
  statev(1) = theta

contains

  ! The elastic part at theta, the residual of its increment and its slope in theta
  subroutine evaluate
    double precision :: speed, slope_of_speed, slope_of_mandel
    be = b/theta**2
    je = j/theta**3
    mandel = 3*lambda*log(je) + mu*(trace(be) - 3)
    excess = (mandel - threshold)/mu
    room = (theta_max - theta)/(theta_max - 1)
    speed = room**2/relaxation
    slope_of_speed = -2*room/(theta_max - 1)/relaxation
    slope_of_mandel = -(9*lambda + 2*mu*trace(be))/theta
    residual = theta - statev(1) - dtime*speed*excess
    slope = 1 - dtime*(slope_of_speed*excess + speed*slope_of_mandel/mu)
  end subroutine evaluate

  pure function trace(a)
    double precision, intent(in) :: a(3, 3)
    double precision :: trace
    trace = a(1, 1) + a(2, 2) + a(3, 3)
  end function trace
end subroutine umat

subroutine sdvini(statev, coords, nstatv, ncrds, noel, npt, layer, kspt)
  implicit none
  integer :: nstatv, ncrds, noel, npt, layer, kspt
  double precision :: statev(nstatv), coords(ncrds)
  statev(1) = 1
end subroutine sdvini
