! VUMAT of Abaqus/Explicit for the laws of libtoron:
! jobs in single precision.
!
! A material with 10 properties and 10 state variables has the linear
! elastic law, one with 13 or 14 properties the yarn law with friction,
! every other one the hyperelastic yarn law: 11 properties and 11 or
! more state variables. One job may have all.
!
! Solids (NDIR = 3; NSHR = 3, or 1 for plane strain and axisymmetric
! ones, with a material whose name ends in _PSTRAIN or _AXIS); *DEPVAR,
! DELETE=11, for the linear elastic law DELETE=10, for that with
! friction DELETE=15: see docs.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops,
     &  lanneal, steptime, totaltime, dt, cmname, coordmp, charlength,
     &  props, density, straininc, relspininc, tempold, stretchold,
     &  defgradold, fieldold, stressold, stateold, enerinternold,
     &  enerinelasold, tempnew, stretchnew, defgradnew, fieldnew,
     &  stressnew, statenew, enerinternnew, enerinelasnew)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int32_t, c_loc, c_null_char, c_ptr, c_size_t, c_sizeof
      implicit none
      character(len=80) :: cmname
      integer :: nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal
      real(c_float) :: steptime, totaltime, dt, coordmp(*)
      real(c_float) :: charlength(*), relspininc(*), tempold(*)
      real(c_float) :: defgradold(*), fieldold(*), tempnew(*)
      real(c_float) :: defgradnew(*), fieldnew(*)
!     What the library reads and writes; arrays are
!     (nblock, components).
      real(c_float), target :: props(*), density(*), straininc(*)
      real(c_float), target :: stretchold(*), stretchnew(*)
      real(c_float), target :: stressold(*), stateold(*)
      real(c_float), target :: enerinternold(*), enerinelasold(*)
      real(c_float), target :: stressnew(*), statenew(*)
      real(c_float), target :: enerinternnew(*), enerinelasnew(*)

      type, bind(c) :: arguments
        integer(c_size_t) :: size
        integer(c_int32_t) :: nblock, ndir, nshr, nstatev, nprops
        integer(c_int32_t) :: level
        real(c_double) :: step_time, total_time
        type(c_ptr) :: props, density, strain_inc
        type(c_ptr) :: stretch_old, stretch_new, stress_old, state_old
        type(c_ptr) :: ener_intern_old, ener_inelas_old
        type(c_ptr) :: stress_new, state_new
        type(c_ptr) :: ener_intern_new, ener_inelas_new
      end type
      type(arguments), target :: block
      integer(c_int32_t) :: status
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char, len=capacity) :: message

      interface
        function toron_abaqus_linear_vumat_f32(block, message,
     &    capacity) bind(c) result(status)
          import :: arguments, c_char, c_int32_t, c_size_t
          type(arguments), target, intent(in) :: block
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_abaqus_frictional_vumat_f32(block, message,
     &    capacity) bind(c) result(status)
          import :: arguments, c_char, c_int32_t, c_size_t
          type(arguments), target, intent(in) :: block
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_abaqus_vumat_f32(block, message, capacity)
     &    bind(c) result(status)
          import :: arguments, c_char, c_int32_t, c_size_t
!         A target: the library writes to what its members point to.
          type(arguments), target, intent(in) :: block
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

!     Plane stress and shells have the same numbers of components.
      if (nshr == 1 .and. .not. announced()) then
        call stop_for('NSHR = 1, as of plane stress, which the laws '//
     &    'do not have; for plane strain and axisymmetric solids '//
     &    'let the name of the material end in _PSTRAIN or _AXIS')
        return
      end if
      block%size = c_sizeof(block)
      block%nblock = int(nblock, c_int32_t)
      block%ndir = int(ndir, c_int32_t)
      block%nshr = int(nshr, c_int32_t)
      block%nstatev = int(nstatev, c_int32_t)
      block%nprops = int(nprops, c_int32_t)
!     The widest instructions that the processor has.
      block%level = 0
      block%step_time = steptime
      block%total_time = totaltime
      block%props = c_loc(props)
      block%density = c_loc(density)
      block%strain_inc = c_loc(straininc)
      block%stretch_old = c_loc(stretchold)
      block%stretch_new = c_loc(stretchnew)
      block%stress_old = c_loc(stressold)
      block%state_old = c_loc(stateold)
      block%ener_intern_old = c_loc(enerinternold)
      block%ener_inelas_old = c_loc(enerinelasold)
      block%stress_new = c_loc(stressnew)
      block%state_new = c_loc(statenew)
      block%ener_intern_new = c_loc(enerinternnew)
      block%ener_inelas_new = c_loc(enerinelasnew)
      if (nprops == 10 .and. nstatev == 10) then
        status = toron_abaqus_linear_vumat_f32(block, message,
     &    capacity)
      else if (nprops == 13 .or. nprops == 14) then
        status = toron_abaqus_frictional_vumat_f32(block, message,
     &    capacity)
      else
        status = toron_abaqus_vumat_f32(block, message, capacity)
      end if
!     Below -300 a point is at fault, and the library has deleted it;
!     above, the deck is.
      if (status < 0 .and. status > -300) call refuse

      contains

      logical function announced()
      integer :: n
      n = len_trim(cmname)
      announced = .false.
      if (n > 8) announced = cmname(n - 7:n) == '_PSTRAIN'
      if (n > 5) announced = announced .or. cmname(n - 4:n) == '_AXIS'
      end function

      subroutine stop_for(text)
      character(len=*), intent(in) :: text
      message = text // c_null_char
      call refuse
      end subroutine

      subroutine refuse
      integer :: length, unit
      length = index(message, c_null_char) - 1
!     The .log or .sta and the .msg file.
      do unit = 6, 7
        write (unit, '(1x, 4a)') 'toron, material ', trim(cmname),
     &    ': ', message(1:length)
      end do
      call xplb_exit
      end subroutine
      end subroutine
