! umat41v of LS-DYNA for the hyperelastic yarn law of libtoron, a block
! of elements at a time (IVECT = 1).
!
! Solids; NHV = 11, IHYPER = -1 with IORTHO = 1, or IHYPER = 1 with
! IORTHO = 0, IFAIL = 1: see docs. The kinds of REAL, INTEGER and
! LOGICAL are those of the build, so compile this file with the object
! package's own flags.
!
! The argument list is that of R11 to R13. Packages of 2014 and 2015
! have no NNPCRV and REJECT, and their IDELEV is a default INTEGER.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine umat41v(cm, d1, d2, d3, d4, d5, d6, sig1, sig2, sig3,
     &  sig4, sig5, sig6, epsps, hsvs, lft, llt, dt1siz, capa, etype,
     &  tt, temps, failels, nlqa, crv, nnpcrv, cma, qmat, elsizv,
     &  idelev, reject)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int, c_int32_t, c_int64_t, c_null_char, c_size_t
      implicit none
      real :: cm(*), d1(*), d2(*), d3(*), d4(*), d5(*), d6(*)
      real :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*)
      real :: epsps(*), hsvs(*), dt1siz(*), capa, tt, temps(*), crv(*)
      real :: cma(*), qmat(*), elsizv(*)
      integer :: lft, llt, nlqa, nnpcrv(*)
      character(len=5) :: etype
      logical :: failels(*), reject
      integer(c_int64_t) :: idelev(*)
!     What the library needs, not what the card says: LS-DYNA hands NHV
!     to no routine. With another one F is not where it is read.
      integer(c_int32_t), parameter :: nhv = 11
      integer(c_int32_t) :: status
      integer(c_int) :: failed(nlqa)
      integer :: i
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char) :: message(capacity)

!     The default kind of REAL picks the precision.
      interface toron_umat_vector
        function toron_lsdyna_umat_vector_f64(cm, sig1, sig2, sig3,
     &    sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels,
     &    message, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int, c_int32_t, c_size_t
          real(c_double), intent(in) :: cm(*)
          real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*)
          real(c_double), intent(inout) :: sig4(*), sig5(*), sig6(*)
          real(c_double), intent(inout) :: hsvs(*)
          integer(c_int32_t), value :: nhv, lft, llt, nlq
          integer(c_int), intent(inout) :: failels(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_lsdyna_umat_vector_f32(cm, sig1, sig2, sig3,
     &    sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels,
     &    message, capacity) bind(c) result(status)
          import :: c_char, c_float, c_int, c_int32_t, c_size_t
          real(c_float), intent(in) :: cm(*)
          real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*)
          real(c_float), intent(inout) :: sig4(*), sig5(*), sig6(*)
          real(c_float), intent(inout) :: hsvs(*)
          integer(c_int32_t), value :: nhv, lft, llt, nlq
          integer(c_int), intent(inout) :: failels(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

      status = toron_umat_vector(cm, sig1, sig2, sig3, sig4, sig5, sig6,
     &  hsvs, nhv, int(lft, c_int32_t), int(llt, c_int32_t),
     &  int(nlqa, c_int32_t), failed, message, capacity)
!     Below -300 an element is at fault, and fails; above, the deck is.
      if (status < 0 .and. status > -300) then
        call refuse
      else
        do i = lft, llt
          failels(i) = failed(i) /= 0
        end do
      end if

      contains

      subroutine refuse
      integer :: length
      length = 0
      do while (message(length + 1) /= c_null_char)
        length = length + 1
      end do
      write (*, '(1x, *(a))') 'toron: ', message(1:length)
      call adios(2)
      end subroutine
      end subroutine
