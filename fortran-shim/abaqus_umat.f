! UMAT of Abaqus/Standard for the laws of libtoron.
!
! A material with 10 properties and 10 state variables has the linear
! elastic law, one with 13 or 14 properties the yarn law with friction,
! every other one the hyperelastic yarn law: 11 properties and 11 or
! more state variables. One job may have all.
!
! Solids (NDI = 3; NSHR = 3, or 1 for plane strain and axisymmetric
! ones) with NLGEOM=YES and no *ORIENTATION: see docs. DDSDDE is
! symmetric for the hyperelastic law alone.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl,
     &  ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp,
     &  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props,
     &  nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt,
     &  layer, kspt, jstep, kinc)
      use, intrinsic :: iso_c_binding, only: c_char, c_double,
     &  c_int32_t, c_null_char, c_size_t
      implicit none
      character(len=80) :: cmname
      integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer
      integer :: kspt, jstep(*), kinc
      real(c_double) :: stress(ntens), statev(nstatv)
      real(c_double) :: ddsdde(ntens, ntens), sse, spd, scd, rpl
      real(c_double) :: ddsddt(ntens), drplde(ntens), drpldt
      real(c_double) :: stran(ntens), dstran(ntens), time(2), dtime
      real(c_double) :: temp, dtemp, predef(*), dpred(*), props(nprops)
      real(c_double) :: coords(3), drot(3, 3), pnewdt, celent
      real(c_double) :: dfgrd0(3, 3), dfgrd1(3, 3)
      integer(c_int32_t) :: status
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char, len=capacity) :: message

      interface
        function toron_abaqus_umat_tangent_f64(stress, statev, ddsdde,
     &    sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr,
     &    nlgeom, message, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          real(c_double), intent(inout) :: stress(*), statev(*)
          real(c_double), intent(inout) :: ddsdde(*), sse, pnewdt
          real(c_double), intent(in) :: dfgrd1(*), props(*)
          integer(c_int32_t), value :: nprops, nstatv, ndi, nshr
          integer(c_int32_t), value :: nlgeom
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_abaqus_linear_umat_f64(stress, statev, ddsdde,
     &    sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi,
     &    nshr, nlgeom, message, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          real(c_double), intent(inout) :: stress(*), statev(*)
          real(c_double), intent(inout) :: ddsdde(*), sse, pnewdt
          real(c_double), intent(in) :: dfgrd0(*), dfgrd1(*), props(*)
          integer(c_int32_t), value :: nprops, nstatv, ndi, nshr
          integer(c_int32_t), value :: nlgeom
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_abaqus_frictional_umat_f64(stress, statev,
     &    ddsdde, sse, spd, pnewdt, dfgrd1, props, nprops, nstatv, ndi,
     &    nshr, nlgeom, message, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          real(c_double), intent(inout) :: stress(*), statev(*)
          real(c_double), intent(inout) :: ddsdde(*), sse, spd, pnewdt
          real(c_double), intent(in) :: dfgrd1(*), props(*)
          integer(c_int32_t), value :: nprops, nstatv, ndi, nshr
          integer(c_int32_t), value :: nlgeom
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

!     JSTEP(3) is 1 with NLGEOM=YES. Releases that pass a scalar KSTEP
!     in its place have no such flag: pass 1 there, and see to
!     NLGEOM=YES yourself.
      if (nprops == 10 .and. nstatv == 10) then
        status = toron_abaqus_linear_umat_f64(stress, statev, ddsdde,
     &    sse, pnewdt, dfgrd0, dfgrd1, props, int(nprops, c_int32_t),
     &    int(nstatv, c_int32_t), int(ndi, c_int32_t),
     &    int(nshr, c_int32_t), int(jstep(3), c_int32_t), message,
     &    capacity)
      else if (nprops == 13 .or. nprops == 14) then
        status = toron_abaqus_frictional_umat_f64(stress, statev,
     &    ddsdde, sse, spd, pnewdt, dfgrd1, props,
     &    int(nprops, c_int32_t), int(nstatv, c_int32_t),
     &    int(ndi, c_int32_t), int(nshr, c_int32_t),
     &    int(jstep(3), c_int32_t), message, capacity)
      else
        status = toron_abaqus_umat_tangent_f64(stress, statev, ddsdde,
     &    sse, pnewdt, dfgrd1, props, int(nprops, c_int32_t),
     &    int(nstatv, c_int32_t), int(ndi, c_int32_t),
     &    int(nshr, c_int32_t), int(jstep(3), c_int32_t), message,
     &    capacity)
      end if
!     Below -300 the point is at fault, and the library has lowered
!     PNEWDT; above, the deck is.
      if (status < 0 .and. status > -300) call refuse

      contains

      subroutine refuse
      integer :: length, unit
      length = index(message, c_null_char) - 1
!     The .dat and the .msg file.
      do unit = 6, 7
        write (unit, '(1x, 4a)') 'toron, material ', trim(cmname),
     &    ': ', message(1:length)
      end do
      call xit
      end subroutine
      end subroutine
