C     Gasser-Ogden-Holzapfel: two families of dispersed fibres in a soft
C     matrix; at rest the fibres lie at +beta and -beta in the plane 1-2.
C
C       W = mu/2 (tr bbar - 3) + kappa/4 (J**2 - 1 - 2 ln J)
C         + k1/(2 k2) sum_f (exp(k2 E_f**2) - 1)     where E_f > 0
C       E_f = tr h_f - 1,  h_f = d bbar + (1 - 3 d) abar abar^T
C
C     PROPS   1 mu, 2 kappa, 3 k1, 4 k2, 5 dispersion d (0 to 1/3),
C             6 beta in degrees
C     STATEV  1, 2 the fibres' strains E_f (for output only)
C     DDSDDE  Jaumann rate of the Kirchhoff stress, over J
C     SSE     W, of the volume at rest
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,RPL,DDSDDT,
     1 DRPLDE,DRPLDT,STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,
     2 CMNAME,NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     3 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),
     2 TIME(2),PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3),JSTEP(4)
      DIMENSION B(3,3),A(3),H(3,3)
      PARAMETER (RADIAN = 3.14159265358979323846D0/180.D0)
C
      DO 10 N = 1, NTENS
        STRESS(N) = 0.D0
        DO 10 M = 1, NTENS
          DDSDDE(M,N) = 0.D0
   10 CONTINUE
      DET = DFGRD1(1,1)*DFGRD1(2,2)*DFGRD1(3,3)
     1    + DFGRD1(1,2)*DFGRD1(2,3)*DFGRD1(3,1)
     2    + DFGRD1(1,3)*DFGRD1(2,1)*DFGRD1(3,2)
     3    - DFGRD1(1,3)*DFGRD1(2,2)*DFGRD1(3,1)
     4    - DFGRD1(1,1)*DFGRD1(2,3)*DFGRD1(3,2)
     5    - DFGRD1(1,2)*DFGRD1(2,1)*DFGRD1(3,3)
      IF (.NOT. DET .GT. 0.D0) THEN
        PNEWDT = 0.25D0
        RETURN
      END IF
      XMU = PROPS(1)
      XKAPPA = PROPS(2)
      XK1 = PROPS(3)
      XK2 = PROPS(4)
      DISP = PROPS(5)
C
      SCALE = DET**(-2.D0/3.D0)
      DO 20 J = 1, 3
        DO 20 I = 1, 3
          B(I,J) = SCALE*(DFGRD1(I,1)*DFGRD1(J,1)
     1           + DFGRD1(I,2)*DFGRD1(J,2) + DFGRD1(I,3)*DFGRD1(J,3))
   20 CONTINUE
C     The matrix is a structure like the fibres', with a constant slope.
      CALL KADD(0.5D0*XMU, 0.D0, B, DET, NTENS, STRESS, DDSDDE)
      SSE = 0.5D0*XMU*(B(1,1) + B(2,2) + B(3,3) - 3.D0)
     1    + 0.25D0*XKAPPA*(DET**2 - 1.D0 - 2.D0*LOG(DET))
C
      DO 50 IFAM = 1, 2
        ANGLE = PROPS(6)*RADIAN
        IF (IFAM .EQ. 2) ANGLE = -ANGLE
        DO 30 I = 1, 3
          A(I) = DET**(-1.D0/3.D0)
     1         * (DFGRD1(I,1)*COS(ANGLE) + DFGRD1(I,2)*SIN(ANGLE))
   30   CONTINUE
        DO 40 J = 1, 3
          DO 40 I = 1, 3
            H(I,J) = DISP*B(I,J) + (1.D0 - 3.D0*DISP)*A(I)*A(J)
   40   CONTINUE
        E = H(1,1) + H(2,2) + H(3,3) - 1.D0
        STATEV(IFAM) = E
        IF (E .GT. 0.D0) THEN
          EXPO = EXP(XK2*E**2)
          SLOPE = XK1*E*EXPO
          CURVE = XK1*(1.D0 + 2.D0*XK2*E**2)*EXPO
          CALL KADD(SLOPE, CURVE, H, DET, NTENS, STRESS, DDSDDE)
          SSE = SSE + 0.5D0*XK1/XK2*(EXPO - 1.D0)
        END IF
   50 CONTINUE
C
      DO 60 M = 1, 3
        STRESS(M) = STRESS(M) + 0.5D0*XKAPPA*(DET - 1.D0/DET)
        DO 60 N = 1, 3
          DDSDDE(M,N) = DDSDDE(M,N) + XKAPPA*DET
   60 CONTINUE
      RETURN
      END
C
C     Adds the Cauchy stress of an energy that depends on tr h alone,
C     2/J SLOPE dev h, and its rate; h = Fbar (structure) Fbar^T
      SUBROUTINE KADD(SLOPE, CURVE, H, DET, NTENS, STRESS, DDSDDE)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION H(3,3),STRESS(NTENS),DDSDDE(NTENS,NTENS),DELTA(3,3),
     1 IROW(6),ICOL(6)
      DATA IROW /1,2,3,1,1,2/, ICOL /1,2,3,2,3,3/
      DATA DELTA /1.D0,3*0.D0,1.D0,3*0.D0,1.D0/
      TRH = H(1,1) + H(2,2) + H(3,3)
      DO 20 M = 1, NTENS
        I = IROW(M)
        J = ICOL(M)
        DEVIJ = H(I,J) - DELTA(I,J)*TRH/3.D0
        STRESS(M) = STRESS(M) + 2.D0*SLOPE/DET*DEVIJ
        DO 10 N = 1, NTENS
          K = IROW(N)
          L = ICOL(N)
          DEVKL = H(K,L) - DELTA(K,L)*TRH/3.D0
          TURNED = DELTA(I,K)*H(J,L) + DELTA(I,L)*H(J,K)
     1           + DELTA(J,L)*H(I,K) + DELTA(J,K)*H(I,L)
          CROSS = DELTA(I,J)*H(K,L) + H(I,J)*DELTA(K,L)
          FIXED = 0.5D0*TURNED - 2.D0/3.D0*CROSS
     1          + 2.D0/9.D0*TRH*DELTA(I,J)*DELTA(K,L)
          DDSDDE(M,N) = DDSDDE(M,N)
     1      + (2.D0*SLOPE*FIXED + 4.D0*CURVE*DEVIJ*DEVKL)/DET
   10   CONTINUE
   20 CONTINUE
      RETURN
      END
